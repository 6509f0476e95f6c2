/* delotet_plc_add_points: new points follow the others; attributes and markers are filled up with 0. */
#include "test.h"

int main(void)
{
    static const double more[6] = {0.5, 0.5, 0.5, 0.25, 0.5, 0.5}, attributes[16] = {1, 2, 3, 4, 5, 6, 7, 8, 9};
    static const int32_t markers[8] = {1, 2, 3, 4, 5, 6, 7, 8};
    DelotetPlc *plc = cube();
    DelotetMesh *mesh;
    uint32_t first = 77;
    OK(delotet_plc_add_points(plc, more, 1, &first, &error));
    CHECK(first == 8 && delotet_plc_points(plc).count == 9 && delotet_plc_point_markers(plc).count == 0);
    delotet_plc_free(plc);
    plc = cube();
    OK(delotet_plc_set_point_attributes(plc, attributes, 2, &error));
    OK(delotet_plc_set_point_markers(plc, markers, &error));
    OK(delotet_plc_add_points(plc, more, 2, NULL, &error));
    OK(delotet_plc_add_points(plc, NULL, 0, &first, &error));
    CHECK(first == 10 && delotet_plc_points(plc).count == 10);
    CHECK(memcmp(delotet_plc_points(plc).data + 24, more, sizeof more) == 0);
    CHECK(delotet_plc_point_markers(plc).count == 10);
    CHECK(delotet_plc_point_markers(plc).data[7] == 8 && delotet_plc_point_markers(plc).data[9] == 0);
    CHECK(delotet_plc_point_attributes(plc).count == 10 && delotet_plc_point_attributes(plc).width == 2);
    CHECK(delotet_plc_point_attributes(plc).data[8] == 9 && delotet_plc_point_attributes(plc).data[19] == 0);
    OK(delotet_plc_add_segment(plc, 8, 9, 4, &error));
    mesh = mesh_with(plc, NULL);
    CHECK(delotet_mesh_points(mesh).count == 10 && near(volume(mesh), 1));
    delotet_mesh_free(mesh);
    FAILS(INVALID, delotet_plc_add_points(plc, NULL, 1, &first, &error));
    FAILS(INVALID, delotet_plc_add_points(plc, more, SIZE_MAX / 8, &first, &error));
    FAILS(INVALID, delotet_plc_add_points(NULL, more, 1, &first, &error));
    CHECK(delotet_plc_points(plc).count == 10);
    delotet_plc_free(plc);
    return 0;
}
