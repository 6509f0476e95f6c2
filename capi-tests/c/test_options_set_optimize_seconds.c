/* delotet_options_set_optimize_seconds: no time gives a valid mesh that is no worse, much time that of a large effort. */
#include "test.h"

/* The smallest dihedral angle of a filled grid. */
static double smallest(const DelotetPlc *plc, const DelotetOptions *options, size_t *tets)
{
    DelotetMesh *mesh = mesh_with(plc, options);
    DelotetTetQualitiesView quality;
    double least = 180;
    size_t i;
    int k;
    OK(delotet_mesh_check_preserved(mesh, plc, 10, &error));
    OK(delotet_mesh_quality(mesh, &quality, &error));
    for (i = 0; i < quality.count; i++) {
        for (k = 0; k < 6; k++) {
            const double angle = DELOTET_AT(DelotetTetQuality, quality, i)->dihedrals[k];
            if (angle < least) least = angle;
        }
    }
    *tets = delotet_mesh_tets(mesh).count;
    delotet_mesh_free(mesh);
    return least;
}

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = grid_box();
    size_t tets, more;
    double none, all;
    OK(delotet_options_set_mode(options, DELOTET_MODE_PRESERVE, &error));
    OK(delotet_options_set_size(options, 1.5, &error));
    none = smallest(plc, options, &tets);
    OK(delotet_options_set_optimize_seconds(options, 1e-9, &error));
    CHECK(smallest(plc, options, &tets) >= none);
    OK(delotet_options_set_optimize_seconds(options, 1e9, &error));
    all = smallest(plc, options, &tets);
    OK(delotet_options_set_optimize_seconds(options, 0, &error));
    OK(delotet_options_set_optimize(options, 100, &error));
    CHECK(smallest(plc, options, &more) == all && more == tets && all > none);
    FAILS(INVALID, delotet_options_set_optimize_seconds(options, -1, &error));
    FAILS(INVALID, delotet_options_set_optimize_seconds(options, INFINITY, &error));
    FAILS(INVALID, delotet_options_set_optimize_seconds(options, NAN, &error));
    FAILS(INVALID, delotet_options_set_optimize_seconds(NULL, 1, &error));
    delotet_plc_free(plc);
    delotet_options_free(options);
    return 0;
}
