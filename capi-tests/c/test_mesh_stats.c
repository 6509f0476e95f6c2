/* delotet_mesh_stats: writes no more than the caller has room for. */
#include "test.h"

/* What keeping the surface took: zero in other modes, and the points inside are those that the mesh has. */
static void preserve(void)
{
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = twisted_prism();
    DelotetMesh *mesh;
    DelotetStats stats;
    OK(delotet_options_set_mode(options, DELOTET_MODE_PRESERVE, &error));
    mesh = mesh_with(plc, options);
    stats.struct_size = sizeof stats;
    OK(delotet_mesh_stats(mesh, &stats, &error));
    CHECK(stats.preserve_interior == delotet_mesh_steiner_points(mesh).count && stats.preserve_interior == 1);
    CHECK(stats.preserve_missing_edges >= 1 && stats.preserve_missing_edges <= 3); /* Of the three reflex ones. */
    CHECK(stats.seconds[DELOTET_PHASE_PRESERVE] > 0);
    delotet_mesh_free(mesh);
    delotet_plc_free(plc);
    delotet_options_free(options);
}

/* Points by size and shape, and optimisation, have times of their own. */
static void refine(void)
{
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = grid_box();
    DelotetMesh *mesh;
    DelotetStats stats;
    DelotetQualitySummary summary;
    double worst;
    OK(delotet_options_set_quality(options, 2, &error));
    OK(delotet_options_set_optimize(options, 1, &error));
    mesh = mesh_with(plc, options);
    stats.struct_size = sizeof stats;
    OK(delotet_mesh_stats(mesh, &stats, &error));
    CHECK(stats.seconds[DELOTET_PHASE_REFINE] > 0 && stats.seconds[DELOTET_PHASE_OPTIMIZE] > 0);
    CHECK(stats.seconds[DELOTET_PHASE_PRESERVE] == 0);
    /* Counts add up to the points that there are. */
    CHECK(stats.refine_for_sizes + stats.refine_for_shapes ==
          stats.refine_on_segments + stats.refine_on_facets + stats.refine_inside);
    CHECK(stats.steiner + stats.refine_for_sizes + stats.refine_for_shapes + stats.optimize_points_added ==
          stats.optimize_points_removed + delotet_mesh_steiner_points(mesh).count);
    CHECK(stats.refine_inside > 0 && stats.refine_over_budget == 0 && stats.optimize_passes > 1);
    CHECK(stats.optimize_worst_after > stats.optimize_worst_before && stats.optimize_worst_before > 0);
    summary.struct_size = sizeof summary;
    OK(delotet_mesh_quality_summary(mesh, &summary, &error));
    worst = summary.worst[DELOTET_QUALITY_MIN_DIHEDRAL];
    if (180 - summary.worst[DELOTET_QUALITY_MAX_DIHEDRAL] < worst)
        worst = 180 - summary.worst[DELOTET_QUALITY_MAX_DIHEDRAL];
    CHECK(fabs(worst - stats.optimize_worst_after) < 1e-6);
    delotet_mesh_free(mesh);
    delotet_plc_free(plc);
    delotet_options_free(options);
}

int main(void)
{
    DelotetMesh *mesh = mesh_of(twisted_prism());
    struct {
        DelotetStats stats;
        unsigned char guard[64];
    } room;
    DelotetStats old;
    memset(&room, 0xAB, sizeof room);
    room.stats.struct_size = sizeof room; /* A newer program: larger than what this library knows. */
    OK(delotet_mesh_stats(mesh, &room.stats, &error));
    CHECK(room.stats.struct_size == sizeof(DelotetStats));
    CHECK(room.guard[0] == 0xAB && room.guard[63] == 0xAB);
    CHECK(room.stats.peak_resident_bytes > 1000000); /* No program that links us is smaller. */
    CHECK(room.stats.steiner == delotet_mesh_steiner_points(mesh).count);
    CHECK(room.stats.seconds[DELOTET_PHASE_DELAUNAY] >= 0 && room.stats.seconds[15] == 0);
    CHECK(room.stats.preserve_missing_edges == 0 && room.stats.preserve_interior == 0);
    CHECK(room.stats.seconds[DELOTET_PHASE_PRESERVE] == 0);
    CHECK(room.stats.refine_inside == 0 && room.stats.optimize_passes == 0 && room.stats.optimize_worst_after == 0);
    CHECK(room.stats.seconds[DELOTET_PHASE_REFINE] == 0 && room.stats.seconds[DELOTET_PHASE_OPTIMIZE] == 0);
    memset(&old, 0xAB, sizeof old);
    old.struct_size = offsetof(DelotetStats, steiner_exact); /* An older program. */
    OK(delotet_mesh_stats(mesh, &old, &error));
    CHECK(old.struct_size == offsetof(DelotetStats, steiner_exact) && old.steiner == room.stats.steiner);
    CHECK(old.steiner_exact == UINT64_C(0xABABABABABABABAB));
    old.struct_size = 0;
    FAILS(INVALID, delotet_mesh_stats(mesh, &old, &error));
    FAILS(INVALID, delotet_mesh_stats(mesh, NULL, &error));
    FAILS(INVALID, delotet_mesh_stats(NULL, &old, &error));
    delotet_mesh_free(mesh);
    preserve();
    refine();
    return 0;
}
