/* delotet_mesh_warning_count: counts those that are not listed too. */
#include "test.h"

int main(void)
{
    double xyz[30];
    DelotetPlc *plc = NULL;
    DelotetOptions *options = delotet_options_new();
    DelotetMesh *mesh;
    box_points(xyz, 0, 1);
    memcpy(xyz + 24, xyz, 6 * sizeof *xyz);
    OK(delotet_plc_new(xyz, 10, &plc, &error));
    OK(delotet_plc_add_triangles(plc, BOX, BOX_MARKERS, 12, &error));
    OK(delotet_options_set_max_defects(options, 0, &error));
    mesh = mesh_with(plc, options);
    CHECK(delotet_mesh_warnings(mesh).count == 0);
    CHECK(delotet_mesh_warning_count(mesh, DELOTET_WARNING_KIND_EQUAL_POINTS) == 2);
    CHECK(delotet_mesh_warning_count(mesh, DELOTET_WARNING_KIND_OPEN_EDGE) == 0);
    CHECK(delotet_mesh_warning_count(mesh, 0) == 0 && delotet_mesh_warning_count(mesh, 1000) == 0);
    CHECK(delotet_mesh_warning_count(NULL, DELOTET_WARNING_KIND_EQUAL_POINTS) == 0);
    delotet_mesh_free(mesh);
    delotet_options_free(options);
    delotet_plc_free(plc);
    return 0;
}
