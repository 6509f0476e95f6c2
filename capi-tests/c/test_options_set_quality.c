/* delotet_options_set_quality: 0, or a ratio of at least 1, for which points are added; the surface is kept, or refined in mode cdt; mode
   delaunay refuses. */
#include "test.h"

/* A mesh in mode cdt: it is constrained Delaunay and has the ratio everywhere, since the box has no small angles. */
static DelotetMesh *refined(const DelotetPlc *plc, const DelotetOptions *options)
{
    DelotetMesh *mesh = mesh_with(plc, options);
    DelotetQualitySummary summary;
    OK(delotet_mesh_check(mesh, plc, true, 10, &error));
    CHECK(fabs(volume(mesh) - GRID * GRID * GRID) < 1e-9);
    summary.struct_size = sizeof summary;
    OK(delotet_mesh_quality_summary(mesh, &summary, &error));
    CHECK(summary.worst[DELOTET_QUALITY_RADIUS_EDGE] <= 2 + 1e-9);
    return mesh;
}

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = grid_box();
    DelotetMesh *mesh = NULL;
    size_t none;
    OK(delotet_options_set_mode(options, DELOTET_MODE_PRESERVE, &error));
    none = points_in_grid(plc, options);
    OK(delotet_options_set_quality(options, 1, &error));
    OK(delotet_options_set_quality(options, 2, &error));
    CHECK(none < points_in_grid(plc, options));
    OK(delotet_options_set_mode(options, DELOTET_MODE_CONSTRAINED, &error));
    delotet_mesh_free(refined(plc, options));
    OK(delotet_options_set_mode(options, DELOTET_MODE_DELAUNAY, &error));
    FAILS(INVALID, delotet_tetrahedralize(plc, options, &mesh, &error));
    CHECK(mesh == NULL);
    FAILS(INVALID, delotet_options_set_quality(options, 0.9999, &error));
    FAILS(INVALID, delotet_options_set_quality(options, 1e-300, &error));
    FAILS(INVALID, delotet_options_set_quality(options, -2, &error));
    FAILS(INVALID, delotet_options_set_quality(options, NAN, &error));
    FAILS(INVALID, delotet_options_set_quality(options, INFINITY, &error));
    FAILS(INVALID, delotet_options_set_quality(NULL, 2, &error));
    delotet_plc_free(plc);
    delotet_options_free(options);
    return 0;
}
