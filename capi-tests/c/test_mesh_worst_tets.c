/* delotet_mesh_worst_tets: in order, filled up, without the forced ones on request. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = cloud(60);
    DelotetMesh *mesh, *wedge = mesh_of(narrow_wedge());
    uint32_t *tets;
    size_t count, i;
    DelotetTetQualitiesView view;
    DelotetForcedTetsView forced;
    DelotetQualitySummary summary;
    OK(delotet_options_set_mode(options, DELOTET_MODE_DELAUNAY, &error));
    mesh = mesh_with(plc, options);
    count = delotet_mesh_tets(mesh).count;
    tets = (uint32_t *)malloc((count + 3) * sizeof *tets);
    CHECK(tets != NULL);
    OK(delotet_mesh_quality(mesh, &view, &error));
    OK(delotet_mesh_worst_tets(mesh, DELOTET_QUALITY_ETA, false, tets, count + 3, &error));
    for (i = 1; i < count; i++)
        CHECK(DELOTET_AT(DelotetTetQuality, view, tets[i - 1])->eta <= DELOTET_AT(DelotetTetQuality, view, tets[i])->eta);
    for (i = count; i < count + 3; i++)
        CHECK(tets[i] == DELOTET_INVALID_INDEX);
    OK(delotet_mesh_worst_tets(mesh, DELOTET_QUALITY_RADIUS_EDGE, true, tets, 2, &error));
    summary.struct_size = sizeof summary;
    OK(delotet_mesh_quality_summary(mesh, &summary, &error));
    CHECK(tets[0] == summary.unforced_worst_tets[DELOTET_QUALITY_RADIUS_EDGE]);
    OK(delotet_mesh_worst_tets(mesh, DELOTET_QUALITY_ETA, false, NULL, 0, &error));
    OK(delotet_mesh_worst_tets(wedge, DELOTET_QUALITY_MIN_DIHEDRAL, true, tets, count, &error));
    OK(delotet_mesh_forced_tets(wedge, &forced, &error));
    for (i = 0; i < forced.count; i++)
        CHECK(DELOTET_AT(DelotetForcedTet, forced, i)->tet != tets[0]);
    FAILS(INVALID, delotet_mesh_worst_tets(mesh, 4, false, tets, 1, &error));
    FAILS(INVALID, delotet_mesh_worst_tets(mesh, DELOTET_QUALITY_ETA, false, NULL, 1, &error));
    FAILS(INVALID, delotet_mesh_worst_tets(NULL, DELOTET_QUALITY_ETA, false, tets, 1, &error));
    delotet_mesh_free(mesh);
    delotet_mesh_free(wedge);
    delotet_plc_free(plc);
    delotet_options_free(options);
    free(tets);
    return 0;
}
