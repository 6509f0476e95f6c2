/* delotet_options_set_background: its sizes are followed, the smaller of them and of the function; wrong ones are refused with the point. */
#include "test.h"

/* A tetrahedron around the grid, whose sizes grow along x. */
static DelotetMesh *around(void)
{
    static const double xyz[12] = {-10, -10, -10, 40, -10, -10, -10, 40, -10, -10, -10, 40};
    static const uint32_t tet[4] = {0, 1, 2, 3};
    DelotetMesh *mesh = NULL;
    OK(delotet_mesh_from_arrays(xyz, 4, 4, tet, 1, NULL, NULL, 0, NULL, NULL, 0, NULL, NULL, &mesh, &error));
    return mesh;
}

static int at_most_one(void *user_data, const double *point, double *size)
{
    (void)user_data;
    (void)point;
    *size = 1;
    return 0;
}

static int no_number(void *user_data, const double *point, double *size)
{
    (void)user_data;
    (void)point;
    *size = NAN;
    return 0;
}

int main(void)
{
    double sizes[4] = {3, 3, 3, 3};
    DelotetOptions *options = delotet_options_new();
    DelotetMesh *mesh = around(), *made = NULL;
    DelotetPlc *plc = grid_box();
    DelotetError *error_of_point = NULL;
    size_t coarse, fine, i, halves[2] = {0, 0};
    OK(delotet_options_set_mode(options, DELOTET_MODE_PRESERVE, &error));
    OK(delotet_options_set_background(options, mesh, sizes, 4, &error));
    coarse = points_in_grid(plc, options);
    OK(delotet_options_set_size_function(options, at_most_one, NULL, &error));
    CHECK(points_in_grid(plc, options) >= coarse);
    OK(delotet_options_set_size_function(options, no_number, NULL, &error));
    FAILS(INVALID, delotet_tetrahedralize(plc, options, &made, &error));
    OK(delotet_options_set_size_function(options, at_most_one, NULL, &error));
    sizes[0] = sizes[2] = sizes[3] = 0.1;
    OK(delotet_options_set_background(options, mesh, sizes, 4, &error));
    fine = points_in_grid(plc, options);
    CHECK(fine > coarse);
    OK(delotet_options_set_size_function(options, NULL, NULL, &error));
    made = mesh_with(plc, options);
    for (i = 0; i < delotet_mesh_points(made).count; i++)
        halves[delotet_mesh_points(made).data[3 * i] > GRID / 2.0]++;
    CHECK(halves[0] > halves[1]);
    delotet_mesh_free(made);
    made = NULL;

    sizes[2] = 0;
    FAILS(INVALID, delotet_options_set_background(options, mesh, sizes, 4, &error));
    sizes[2] = -1;
    FAILS(INVALID, delotet_options_set_background(options, mesh, sizes, 4, &error));
    sizes[2] = NAN;
    CHECK(delotet_options_set_background(options, mesh, sizes, 4, &error_of_point) == INVALID);
    CHECK(strstr(delotet_error_message(error_of_point), "of point 2 ") != NULL);
    delotet_error_free(error_of_point);
    sizes[2] = 1;
    FAILS(INVALID, delotet_options_set_background(options, mesh, sizes, 3, &error));
    FAILS(INVALID, delotet_options_set_background(options, mesh, NULL, 4, &error));
    FAILS(INVALID, delotet_options_set_background(NULL, mesh, sizes, 4, &error));
    /* What is refused changes nothing. */
    CHECK(delotet_options_background(options).data[2] == 0.1);
    OK(delotet_options_set_size_function(options, at_most_one, NULL, &error));
    CHECK(points_in_grid(plc, options) == fine);
    delotet_mesh_free(mesh);
    CHECK(points_in_grid(plc, options) == fine);
    OK(delotet_options_set_size_function(options, NULL, NULL, &error));
    OK(delotet_options_set_background(options, NULL, NULL, 0, &error));
    CHECK(points_in_grid(plc, options) <= coarse);
    delotet_plc_free(plc);
    delotet_options_free(options);
    return 0;
}
