/* delotet_plc_add_polygons: a cube of six squares. */
#include "test.h"

int main(void)
{
    static const uint32_t corners[24] = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
    static const size_t ends[6] = {4, 8, 12, 16, 20, 24}, flat[2] = {4, 4}, falling[2] = {8, 4}, zero[1] = {0};
    static const int32_t markers[6] = {1, 2, 3, 4, 5, 6};
    static const uint32_t wrong[8] = {0, 1, 2, 3, 4, 5, 6, 8};
    double xyz[24];
    DelotetPlc *plc = NULL;
    DelotetMesh *mesh;
    DelotetError *error = NULL;
    DelotetSubfacesView pieces;
    size_t i;
    box_points(xyz, 0, 1);
    OK(delotet_plc_new(xyz, 8, &plc, &error));
    FAILS(INVALID, delotet_plc_add_polygons(plc, corners, flat, NULL, 2, &error));
    FAILS(INVALID, delotet_plc_add_polygons(plc, corners, falling, NULL, 2, &error));
    FAILS(INVALID, delotet_plc_add_polygons(plc, corners, zero, NULL, 1, &error));
    FAILS(INVALID, delotet_plc_add_polygons(plc, NULL, ends, NULL, 1, &error));
    FAILS(INVALID, delotet_plc_add_polygons(plc, corners, NULL, NULL, 1, &error));
    FAILS(INVALID, delotet_plc_add_polygons(NULL, corners, ends, NULL, 1, &error));
    CHECK(delotet_plc_add_polygons(plc, wrong, ends, NULL, 2, &error) == DELOTET_STATUS_INDEX_OUT_OF_RANGE);
    CHECK(DELOTET_AT(DelotetDefect, delotet_error_defects(error), 0)->first == 1);
    delotet_error_free(error);
    CHECK(delotet_plc_facet_count(plc) == 0);
    OK(delotet_plc_add_polygons(plc, corners, ends, markers, 6, &error));
    mesh = mesh_of(plc);
    CHECK(near(volume(mesh), 1));
    pieces = delotet_mesh_subfaces(mesh);
    CHECK(pieces.count == 12);
    for (i = 0; i < pieces.count; i++) {
        const DelotetSubface *piece = DELOTET_AT(DelotetSubface, pieces, i);
        CHECK(piece->marker == (int32_t)piece->facet + 1);
    }
    delotet_mesh_free(mesh);
    return 0;
}
