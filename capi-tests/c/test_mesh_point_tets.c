/* delotet_mesh_point_tets: a tetrahedron that has the point, or none. */
#include "test.h"

int main(void)
{
    DelotetPlc *plc = NULL;
    double xyz[27];
    DelotetMesh *mesh;
    DelotetIndicesView view;
    uint32_t point;
    box_points(xyz, 0, 1);
    xyz[24] = xyz[25] = xyz[26] = 0; /* Corner 0 again: used by no tetrahedron. */
    OK(delotet_plc_new(xyz, 9, &plc, &error));
    OK(delotet_plc_add_triangles(plc, BOX, NULL, 12, &error));
    mesh = mesh_of(plc);
    OK(delotet_mesh_point_tets(mesh, &view, &error));
    CHECK(view.count == 9 && view.data[8] == DELOTET_INVALID_INDEX);
    for (point = 0; point < 8; point++) {
        const uint32_t *tet = delotet_mesh_tets(mesh).data + 4 * view.data[point];
        CHECK(tet[0] == point || tet[1] == point || tet[2] == point || tet[3] == point);
    }
    FAILS(INVALID, delotet_mesh_point_tets(NULL, &view, &error));
    FAILS(INVALID, delotet_mesh_point_tets(mesh, NULL, &error));
    delotet_mesh_free(mesh);
    return 0;
}
