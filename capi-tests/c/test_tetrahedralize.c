/* delotet_tetrahedralize: a cube, the same twice; input that cannot be meshed; misuse. All this also in the mode that keeps the surface. */
#include "test.h"

/* Markers, regions, holes and the hull with the surface kept. */
static void preserve(void)
{
    static const double hole[3] = {1.5, 1.5, 1.5}, room[3] = {0.5, 0.5, 0.5};
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = nested_boxes(), *bad = pierced();
    DelotetMesh *mesh, *none = NULL;
    size_t i;
    OK(delotet_options_set_mode(options, DELOTET_MODE_PRESERVE, &error));
    OK(delotet_plc_add_hole(plc, hole, &error));
    OK(delotet_plc_add_region(plc, room, 10, 0.5, &error));
    mesh = mesh_with(plc, options);
    OK(delotet_mesh_check_preserved(mesh, plc, 10, &error));
    CHECK(near(volume(mesh), 26) && delotet_mesh_regions(mesh).count == 1);
    CHECK(near(DELOTET_AT(DelotetRegion, delotet_mesh_regions(mesh), 0)->attribute, 10) && DELOTET_AT(DelotetRegion, delotet_mesh_regions(mesh), 0)->seed == 0);
    CHECK(delotet_mesh_subfaces(mesh).count == 24);
    for (i = 0; i < 24; i++) {
        DelotetSubface face = *DELOTET_AT(DelotetSubface, delotet_mesh_subfaces(mesh), i);
        CHECK(face.facet < 24 && face.marker == delotet_plc_facet_marker(plc, face.facet));
        CHECK(face.tets[0] != DELOTET_INVALID_INDEX && face.tets[1] == DELOTET_INVALID_INDEX);
    }
    delotet_mesh_free(mesh);
    FAILS(DELOTET_STATUS_SELF_INTERSECTION, delotet_tetrahedralize(bad, options, &none, &error));
    CHECK(none == NULL);
    delotet_plc_free(plc);
    delotet_plc_free(bad);
    /* The twisted prism in its convex hull. */
    plc = twisted_prism();
    OK(delotet_options_set_keep_hull(options, true, &error));
    mesh = mesh_with(plc, options);
    OK(delotet_mesh_check_preserved(mesh, plc, 10, &error));
    OK(delotet_options_set_mode(options, DELOTET_MODE_DELAUNAY, &error));
    none = mesh_with(plc, options);
    CHECK(near(volume(mesh), volume(none)));
    delotet_mesh_free(mesh);
    delotet_mesh_free(none);
    delotet_plc_free(plc);
    delotet_options_free(options);
}

int main(void)
{
    static const double flat[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    DelotetPlc *plc = cube(), *bad = pierced(), *empty = NULL;
    DelotetMesh *a = mesh_with(plc, NULL), *b = mesh_with(plc, NULL), *none = a;
    CHECK(delotet_mesh_points(a).count == 8);
    CHECK(memcmp(delotet_mesh_tets(a).data, delotet_mesh_tets(b).data, 16 * delotet_mesh_tets(a).count) == 0);
    FAILS(DELOTET_STATUS_SELF_INTERSECTION, delotet_tetrahedralize(bad, NULL, &none, &error));
    CHECK(none == NULL);
    CHECK(delotet_tetrahedralize(bad, NULL, &none, NULL) == DELOTET_STATUS_SELF_INTERSECTION);
    FAILS(INVALID, delotet_tetrahedralize(NULL, NULL, &none, &error));
    FAILS(INVALID, delotet_tetrahedralize(plc, NULL, NULL, &error));
    OK(delotet_plc_new(flat, 4, &empty, &error));
    FAILS(DELOTET_STATUS_DEGENERATE_INPUT, delotet_tetrahedralize(empty, NULL, &none, &error));
    delotet_plc_free(empty);
    delotet_plc_free(plc);
    delotet_plc_free(bad);
    delotet_mesh_free(a);
    delotet_mesh_free(b);
    preserve();
    return 0;
}
