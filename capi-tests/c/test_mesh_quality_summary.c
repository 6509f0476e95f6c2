/* delotet_mesh_quality_summary: histograms add up, worst values are those of the tetrahedra named, and no more is written than fits. */
#include "test.h"

static double value(const DelotetTetQuality *quality, int measure)
{
    double low = 180, high = 0;
    int i;
    for (i = 0; i < 6; i++) {
        low = fmin(low, quality->dihedrals[i]);
        high = fmax(high, quality->dihedrals[i]);
    }
    return measure == DELOTET_QUALITY_MIN_DIHEDRAL   ? low
           : measure == DELOTET_QUALITY_MAX_DIHEDRAL ? high
           : measure == DELOTET_QUALITY_RADIUS_EDGE  ? quality->radius_edge
                                                     : quality->eta;
}

int main(void)
{
    DelotetMesh *mesh = mesh_of(narrow_wedge());
    DelotetTetQualitiesView view;
    DelotetForcedTetsView forced;
    DelotetQualitySummary summary, old;
    uint64_t all, unforced;
    int i, bin;
    summary.struct_size = sizeof summary;
    OK(delotet_mesh_quality_summary(mesh, &summary, &error));
    OK(delotet_mesh_quality(mesh, &view, &error));
    OK(delotet_mesh_forced_tets(mesh, &forced, &error));
    CHECK(summary.struct_size == sizeof summary && summary.tet_count == view.count);
    CHECK(summary.forced_count == forced.count && forced.count > 0);
    for (i = 0; i < DELOTET_QUALITY_MEASURES; i++) {
        all = unforced = 0;
        for (bin = 0; bin < DELOTET_QUALITY_BINS; bin++) {
            all += summary.histograms[i][bin];
            unforced += summary.unforced_histograms[i][bin];
            CHECK(summary.unforced_histograms[i][bin] <= summary.histograms[i][bin]);
        }
        CHECK(all == view.count && unforced == view.count - forced.count);
        CHECK(value(DELOTET_AT(DelotetTetQuality, view, summary.worst_tets[i]), i) == summary.worst[i]);
    }
    CHECK(summary.worst[DELOTET_QUALITY_MIN_DIHEDRAL] <= 10.000001);
    CHECK(summary.worst[DELOTET_QUALITY_MAX_DIHEDRAL] >= 90);
    memset(&old, 0xAB, sizeof old);
    old.struct_size = offsetof(DelotetQualitySummary, forced_count); /* An older program. */
    OK(delotet_mesh_quality_summary(mesh, &old, &error));
    CHECK(old.tet_count == view.count && old.forced_count == UINT64_C(0xABABABABABABABAB));
    old.struct_size = 0;
    FAILS(INVALID, delotet_mesh_quality_summary(mesh, &old, &error));
    FAILS(INVALID, delotet_mesh_quality_summary(mesh, NULL, &error));
    FAILS(INVALID, delotet_mesh_quality_summary(NULL, &summary, &error));
    delotet_mesh_free(mesh);
    return 0;
}
