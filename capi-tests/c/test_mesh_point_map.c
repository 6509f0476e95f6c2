/* delotet_mesh_point_map: from the input's points to the mesh's, where some were left out. */
#include "test.h"

/* The unit cube with a loose point before its corners and a corner once more behind them. */
static DelotetPlc *shifted_cube(void)
{
    double xyz[30] = {7, 7, 7};
    uint32_t corners[36];
    DelotetPlc *plc = NULL;
    int i;
    box_points(xyz + 3, 0, 1);
    memcpy(xyz + 27, xyz + 9, 3 * sizeof *xyz);
    for (i = 0; i < 36; i++)
        corners[i] = BOX[i] + 1;
    OK(delotet_plc_new(xyz, 10, &plc, &error));
    OK(delotet_plc_add_triangles(plc, corners, NULL, 12, &error));
    return plc;
}

int main(void)
{
    DelotetPlc *plc = shifted_cube();
    DelotetOptions *options = delotet_options_new();
    DelotetMesh *mesh = mesh_with(plc, options);
    DelotetIndicesView map = delotet_mesh_point_map(mesh);
    uint32_t i;
    CHECK(map.count == 0 && map.data == NULL);
    delotet_mesh_free(mesh);
    OK(delotet_options_set_drop_unmeshed_points(options, true, &error));
    mesh = mesh_with(plc, options);
    map = delotet_mesh_point_map(mesh);
    CHECK(map.count == 10 && map.data[0] == DELOTET_INVALID_INDEX && map.data[9] == 2);
    for (i = 1; i < 9; i++)
        CHECK(map.data[i] == i - 1);
    CHECK(memcmp(delotet_mesh_points(mesh).data, delotet_plc_points(plc).data + 3, 24 * sizeof(double)) == 0);
    CHECK(delotet_mesh_point_map(NULL).count == 0);
    delotet_mesh_free(mesh);
    delotet_options_free(options);
    delotet_plc_free(plc);
    return 0;
}
