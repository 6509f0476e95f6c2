/* delotet_options_set_min_angle: the mesh is optimised until it has the angle where that can be; modes as for
   delotet_options_set_optimize. */
#include "test.h"

static double least_angle(DelotetOptions *options, const DelotetPlc *plc, uint32_t effort, double degrees)
{
    DelotetQualitySummary summary;
    DelotetMesh *mesh;
    OK(delotet_options_set_optimize(options, effort, &error));
    OK(delotet_options_set_min_angle(options, degrees, &error));
    mesh = mesh_with(plc, options);
    OK(delotet_mesh_check_preserved(mesh, plc, 10, &error));
    CHECK(fabs(volume(mesh) - GRID * GRID * GRID) < 1e-9);
    summary.struct_size = sizeof summary;
    OK(delotet_mesh_quality_summary(mesh, &summary, &error));
    delotet_mesh_free(mesh);
    return summary.worst[DELOTET_QUALITY_MIN_DIHEDRAL];
}

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = grid_box();
    DelotetMesh *mesh = NULL;
    double before, after;
    OK(delotet_options_set_mode(options, DELOTET_MODE_PRESERVE, &error));
    OK(delotet_options_set_size(options, 2, &error));
    before = least_angle(options, plc, 0, 0);
    after = least_angle(options, plc, 0, 25);
    CHECK(after > before && after >= 25);
    before = least_angle(options, plc, 1, 0);
    after = least_angle(options, plc, 1, 60); /* That is more than can be. */
    CHECK(after >= before && after < 60);
    FAILS(INVALID, delotet_options_set_min_angle(options, -1, &error));
    FAILS(INVALID, delotet_options_set_min_angle(options, 61, &error));
    FAILS(INVALID, delotet_options_set_min_angle(options, NAN, &error));
    FAILS(INVALID, delotet_options_set_min_angle(options, INFINITY, &error));
    FAILS(INVALID, delotet_options_set_min_angle(NULL, 20, &error));
    OK(delotet_options_set_size(options, 0, &error));
    OK(delotet_options_set_mode(options, DELOTET_MODE_DELAUNAY, &error));
    FAILS(INVALID, delotet_tetrahedralize(plc, options, &mesh, &error));
    CHECK(mesh == NULL);
    delotet_plc_free(plc);
    delotet_options_free(options);
    return 0;
}
