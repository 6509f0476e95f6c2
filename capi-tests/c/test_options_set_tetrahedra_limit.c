/* delotet_options_set_tetrahedra_limit: as many tetrahedra as there are may be, one less may not; also while the mesh is filled. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = twisted_prism();
    DelotetMesh *mesh = NULL;
    int size;
    for (size = 0; size < 2; size++) {
        size_t count;
        OK(delotet_options_set_size(options, size ? 0.3 : 0, &error));
        mesh = mesh_with(plc, options);
        count = delotet_mesh_tets(mesh).count;
        delotet_mesh_free(mesh);
        mesh = NULL;
        OK(delotet_options_set_tetrahedra_limit(options, count - 1, &error));
        FAILS(DELOTET_STATUS_TETRAHEDRA_LIMIT, delotet_tetrahedralize(plc, options, &mesh, &error));
        CHECK(mesh == NULL);
        OK(delotet_options_set_tetrahedra_limit(options, count, &error));
        mesh = mesh_with(plc, options);
        CHECK(delotet_mesh_tets(mesh).count == count);
        delotet_mesh_free(mesh);
        OK(delotet_options_set_tetrahedra_limit(options, UINT64_MAX, &error));
    }
    FAILS(INVALID, delotet_options_set_tetrahedra_limit(NULL, 1, &error));
    delotet_plc_free(plc);
    delotet_options_free(options);
    return 0;
}
