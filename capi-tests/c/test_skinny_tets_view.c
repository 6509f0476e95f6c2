/* delotet_skinny_tets_view: exactly the tetrahedra above the ratio, in ascending order; those in a wedge name its facets. */
#include "test.h"

int main(void)
{
    const double ratio = 1;
    DelotetMesh *mesh = mesh_of(narrow_wedge());
    DelotetSkinnyTets *tets = NULL;
    DelotetSkinnyTetsView view;
    DelotetForcedTetsView forced;
    DelotetTetQualitiesView qualities;
    size_t i, next = 0, known = 0;
    OK(delotet_mesh_quality(mesh, &qualities, &error));
    OK(delotet_mesh_forced_tets(mesh, &forced, &error));
    OK(delotet_skinny_tets_new(mesh, ratio, &tets, &error));
    view = delotet_skinny_tets_view(tets);
    CHECK(view.count > 0 && view.stride == sizeof(DelotetSkinnyTet));
    for (i = 0; i < qualities.count; i++) {
        const DelotetTetQuality *quality = DELOTET_AT(DelotetTetQuality, qualities, i);
        const DelotetSkinnyTet *tet = NULL;
        const DelotetForcedTet *wedge = NULL;
        if (known < forced.count && DELOTET_AT(DelotetForcedTet, forced, known)->tet == i)
            wedge = DELOTET_AT(DelotetForcedTet, forced, known++);
        if (quality->radius_edge <= ratio)
            continue;
        CHECK(next < view.count);
        tet = DELOTET_AT(DelotetSkinnyTet, view, next++);
        CHECK(tet->tet == i && tet->radius_edge == quality->radius_edge);
        CHECK((tet->cause == DELOTET_SKINNY_WEDGE) == (wedge != NULL));
        if (wedge)
            CHECK(memcmp(tet->facets, wedge->facets, sizeof tet->facets) == 0);
    }
    CHECK(next == view.count && known == forced.count);
    delotet_skinny_tets_free(tets);
    OK(delotet_skinny_tets_new(mesh, 1e6, &tets, &error));
    CHECK(delotet_skinny_tets_view(tets).first == NULL && delotet_skinny_tets_view(tets).count == 0);
    CHECK(delotet_skinny_tets_view(NULL).first == NULL && delotet_skinny_tets_view(NULL).count == 0);
    delotet_skinny_tets_free(tets);
    delotet_mesh_free(mesh);
    return 0;
}
