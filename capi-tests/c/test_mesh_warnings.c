/* delotet_mesh_warnings: a point that equals another one is listed with both, at most as often as requested, and logged. */
#include "test.h"

static DelotetPlc *cube_with_equal_points(void)
{
    double xyz[30];
    DelotetPlc *plc = NULL;
    box_points(xyz, 0, 1);
    memcpy(xyz + 24, xyz + 9, 3 * sizeof *xyz);
    memcpy(xyz + 27, xyz + 6, 3 * sizeof *xyz);
    OK(delotet_plc_new(xyz, 10, &plc, &error));
    OK(delotet_plc_add_triangles(plc, BOX, BOX_MARKERS, 12, &error));
    return plc;
}

static void log_line(void *user_data, const char *message)
{
    CHECK(strncmp(message, "warning: 2 points equal earlier ones", 36) == 0);
    ++*(int *)user_data;
}

int main(void)
{
    DelotetPlc *plc = cube_with_equal_points();
    DelotetOptions *options = delotet_options_new();
    DelotetMesh *mesh = mesh_with(plc, NULL);
    DelotetWarningsView view = delotet_mesh_warnings(mesh);
    int lines = 0;
    CHECK(view.count == 2 && view.stride == sizeof(DelotetWarning));
    CHECK(DELOTET_AT(DelotetWarning, view, 0)->kind == DELOTET_WARNING_KIND_EQUAL_POINTS);
    CHECK(DELOTET_AT(DelotetWarning, view, 0)->first_element == DELOTET_ELEMENT_POINT && DELOTET_AT(DelotetWarning, view, 0)->first == 8);
    CHECK(DELOTET_AT(DelotetWarning, view, 0)->second_element == DELOTET_ELEMENT_POINT && DELOTET_AT(DelotetWarning, view, 0)->second == 3);
    CHECK(DELOTET_AT(DelotetWarning, view, 0)->has_point == 1 && DELOTET_AT(DelotetWarning, view, 0)->point[0] == 1 && DELOTET_AT(DelotetWarning, view, 0)->point[2] == 0);
    CHECK(DELOTET_AT(DelotetWarning, view, 1)->first == 9 && DELOTET_AT(DelotetWarning, view, 1)->second == 2);
    CHECK(delotet_mesh_warnings(NULL).count == 0 && delotet_mesh_warnings(NULL).first == NULL);
    delotet_mesh_free(mesh);

    OK(delotet_options_set_max_defects(options, 1, &error));
    OK(delotet_options_set_log(options, log_line, &lines, &error));
    mesh = mesh_with(plc, options);
    CHECK(delotet_mesh_warnings(mesh).count == 1 && lines == 1);
    delotet_mesh_free(mesh);
    delotet_options_free(options);
    delotet_plc_free(plc);

    mesh = mesh_of(cube());
    CHECK(delotet_mesh_warnings(mesh).count == 0 && delotet_mesh_warnings(mesh).first == NULL);
    delotet_mesh_free(mesh);
    return 0;
}
