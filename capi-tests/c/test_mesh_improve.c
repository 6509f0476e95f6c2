/* delotet_mesh_improve: the worst angle never falls, and what is kept stays. */
#include "test.h"

static double worst(const DelotetMesh *mesh)
{
    DelotetQualitySummary summary;
    summary.struct_size = sizeof summary;
    OK(delotet_mesh_quality_summary(mesh, &summary, &error));
    return summary.worst[DELOTET_QUALITY_MIN_DIHEDRAL];
}

int main(void)
{
    DelotetPlc *plc = grid_box();
    DelotetOptions *options = delotet_options_new();
    DelotetMesh *mesh, *better = NULL, *best = NULL;
    DelotetCancelToken *token = delotet_cancel_token_new();
    OK(delotet_options_set_mode(options, DELOTET_MODE_PRESERVE, &error));
    OK(delotet_options_set_size(options, 1, &error));
    mesh = mesh_with(plc, options);
    OK(delotet_mesh_improve(mesh, NULL, &better, &error));
    OK(delotet_mesh_check_preserved(better, plc, 10, &error));
    CHECK(worst(better) > worst(mesh) && near(volume(better), volume(mesh)));
    OK(delotet_options_set_optimize(options, 2, &error));
    OK(delotet_mesh_improve(better, options, &best, &error));
    OK(delotet_mesh_check_preserved(best, plc, 10, &error));
    CHECK(worst(best) >= worst(better));
    delotet_mesh_free(best);
    FAILS(INVALID, delotet_mesh_improve(NULL, NULL, &best, &error));
    FAILS(INVALID, delotet_mesh_improve(mesh, NULL, NULL, &error));
    OK(delotet_options_set_cancel_token(options, token, &error));
    delotet_cancel_token_cancel(token);
    FAILS(DELOTET_STATUS_CANCELLED, delotet_mesh_improve(mesh, options, &best, &error));
    CHECK(best == NULL);
    delotet_cancel_token_free(token);
    delotet_mesh_free(better);
    delotet_mesh_free(mesh);
    delotet_options_free(options);
    delotet_plc_free(plc);
    return 0;
}
