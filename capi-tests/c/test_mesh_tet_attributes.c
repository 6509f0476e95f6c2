/* delotet_mesh_tet_attributes: the attribute of each tetrahedron's region. */
#include "test.h"

int main(void)
{
    static const double seed[3] = {0.5, 0.5, 0.5};
    DelotetPlc *plc = cube();
    DelotetMesh *mesh;
    DelotetDoublesView view;
    size_t i;
    OK(delotet_plc_add_region(plc, seed, 2.25, 0, &error));
    mesh = mesh_of(plc);
    OK(delotet_mesh_tet_attributes(mesh, &view, &error));
    CHECK(view.count == delotet_mesh_tets(mesh).count && view.width == 1);
    for (i = 0; i < view.count; i++)
        CHECK(view.data[i] == 2.25);
    FAILS(INVALID, delotet_mesh_tet_attributes(NULL, &view, &error));
    FAILS(INVALID, delotet_mesh_tet_attributes(mesh, NULL, &error));
    delotet_mesh_free(mesh);
    return 0;
}
