/* delotet_options_set_keep_hull: the whole convex hull is kept. */
#include "test.h"

int main(void)
{
    static const double xyz[15] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4, 4, 4, 4};
    static const uint32_t corners[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = NULL;
    DelotetMesh *mesh;
    OK(delotet_plc_new(xyz, 5, &plc, &error));
    OK(delotet_plc_add_triangles(plc, corners, NULL, 4, &error));
    mesh = mesh_with(plc, options);
    CHECK(delotet_mesh_tets(mesh).count == 1);
    delotet_mesh_free(mesh);
    OK(delotet_options_set_keep_hull(options, true, &error));
    mesh = mesh_with(plc, options);
    CHECK(delotet_mesh_tets(mesh).count == 2);
    delotet_mesh_free(mesh);
    FAILS(INVALID, delotet_options_set_keep_hull(NULL, true, &error));
    delotet_plc_free(plc);
    delotet_options_free(options);
    return 0;
}
