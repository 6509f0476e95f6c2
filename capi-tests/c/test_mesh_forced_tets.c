/* delotet_mesh_forced_tets: a wedge of 10 degrees names its two facets; a cube forces nothing. */
#include "test.h"

int main(void)
{
    DelotetMesh *mesh = mesh_of(narrow_wedge()), *fine = mesh_of(cube());
    DelotetForcedTetsView view, again;
    size_t i;
    OK(delotet_mesh_forced_tets(mesh, &view, &error));
    CHECK(view.count > 0 && view.stride == sizeof(DelotetForcedTet));
    for (i = 0; i < view.count; i++) {
        const DelotetForcedTet *forced = DELOTET_AT(DelotetForcedTet, view, i);
        /* A side is two triangles, of which one stands for both. */
        CHECK(forced->facets[0] / 2 == 1 && forced->facets[1] / 2 == 3);
        CHECK(forced->ends[0] == 0 && forced->ends[1] == 3);
        CHECK(fabs(forced->angle - 10) < 1e-12 && forced->angle < DELOTET_QUALITY_FORCED_BELOW);
        CHECK(i == 0 || DELOTET_AT(DelotetForcedTet, view, i - 1)->tet < forced->tet);
    }
    OK(delotet_mesh_forced_tets(mesh, &again, &error));
    CHECK(again.first == view.first);
    OK(delotet_mesh_forced_tets(fine, &view, &error));
    CHECK(view.first == NULL && view.count == 0);
    FAILS(INVALID, delotet_mesh_forced_tets(NULL, &view, &error));
    FAILS(INVALID, delotet_mesh_forced_tets(mesh, NULL, &error));
    delotet_mesh_free(mesh);
    delotet_mesh_free(fine);
    return 0;
}
