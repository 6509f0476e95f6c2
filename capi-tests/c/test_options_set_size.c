/* delotet_options_set_size: smaller sizes make more points; the surface is kept, or refined in mode cdt; mode delaunay refuses. */
#include "test.h"

/* The number of points where the surface is refined. */
static size_t refined_points(const DelotetPlc *plc, const DelotetOptions *options)
{
    DelotetMesh *mesh = mesh_with(plc, options);
    size_t count = delotet_mesh_points(mesh).count;
    OK(delotet_mesh_check(mesh, plc, true, 10, &error));
    CHECK(fabs(volume(mesh) - GRID * GRID * GRID) < 1e-9);
    delotet_mesh_free(mesh);
    return count;
}

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = grid_box();
    DelotetMesh *mesh = NULL;
    size_t none, coarse, fine;
    OK(delotet_options_set_mode(options, DELOTET_MODE_PRESERVE, &error));
    none = points_in_grid(plc, options);
    OK(delotet_options_set_size(options, 3, &error));
    coarse = points_in_grid(plc, options);
    OK(delotet_options_set_size(options, 0.5, &error));
    fine = points_in_grid(plc, options);
    CHECK(none < coarse && coarse < fine);
    OK(delotet_options_set_size(options, 0, &error));
    CHECK(points_in_grid(plc, options) == none);
    FAILS(INVALID, delotet_options_set_size(options, -1, &error));
    FAILS(INVALID, delotet_options_set_size(options, NAN, &error));
    FAILS(INVALID, delotet_options_set_size(options, INFINITY, &error));
    FAILS(INVALID, delotet_options_set_size(NULL, 1, &error));
    OK(delotet_options_set_size(options, 1, &error));
    OK(delotet_options_set_mode(options, DELOTET_MODE_CONSTRAINED, &error));
    OK(delotet_options_set_size(options, 3, &error));
    coarse = refined_points(plc, options);
    OK(delotet_options_set_size(options, 0.5, &error));
    CHECK(coarse < refined_points(plc, options) && fine < refined_points(plc, options));
    OK(delotet_options_set_mode(options, DELOTET_MODE_DELAUNAY, &error));
    FAILS(INVALID, delotet_tetrahedralize(plc, options, &mesh, &error));
    CHECK(mesh == NULL);
    delotet_plc_free(plc);
    delotet_options_free(options);
    return 0;
}
