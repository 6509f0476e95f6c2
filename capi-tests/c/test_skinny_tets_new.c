/* delotet_skinny_tets_new: the ratio that was asked for by default; what forces a tetrahedron is named, with what is beside it. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = cube_with_blade();
    DelotetMesh *mesh = mesh_with(plc, NULL), *fine;
    DelotetSkinnyTets *tets = NULL;
    DelotetSkinnyTetsView view;
    size_t i, corner = 0, beside = 0;
    OK(delotet_skinny_tets_new(mesh, 0, &tets, &error));
    CHECK(delotet_skinny_tets_ratio(tets) == 2);
    delotet_skinny_tets_free(tets);
    OK(delotet_options_set_quality(options, 1.5, &error));
    fine = mesh_with(plc, options);
    OK(delotet_skinny_tets_new(fine, 0, &tets, &error));
    delotet_mesh_free(fine);
    CHECK(delotet_skinny_tets_ratio(tets) == 1.5);
    view = delotet_skinny_tets_view(tets);
    for (i = 0; i < view.count; i++) {
        const DelotetSkinnyTet *tet = DELOTET_AT(DelotetSkinnyTet, view, i);
        CHECK(tet->radius_edge > 1.5);
        corner += tet->cause == DELOTET_SKINNY_CORNER;
        beside += tet->cause == DELOTET_SKINNY_BESIDE;
        if (tet->cause == DELOTET_SKINNY_OTHER)
            CHECK(tet->facets[0] == DELOTET_INVALID_INDEX && tet->facets[1] == DELOTET_INVALID_INDEX);
        else
            CHECK(tet->facets[0] == 12 && tet->facets[1] == 12);
        /* No triangle there has a larger angle. */
        if (tet->cause == DELOTET_SKINNY_CORNER)
            CHECK(tet->radius_edge > 0.999 / (2 * sin(10 * acos(-1.0) / 180)));
    }
    CHECK(corner > 0 && beside > 0);
    delotet_skinny_tets_free(tets);

    FAILS(INVALID, delotet_skinny_tets_new(mesh, -1, &tets, &error));
    CHECK(tets == NULL);
    FAILS(INVALID, delotet_skinny_tets_new(mesh, NAN, &tets, &error));
    FAILS(INVALID, delotet_skinny_tets_new(mesh, INFINITY, &tets, &error));
    FAILS(INVALID, delotet_skinny_tets_new(NULL, 2, &tets, &error));
    FAILS(INVALID, delotet_skinny_tets_new(mesh, 2, NULL, &error));
    delotet_mesh_free(mesh);
    delotet_plc_free(plc);
    delotet_options_free(options);
    return 0;
}
