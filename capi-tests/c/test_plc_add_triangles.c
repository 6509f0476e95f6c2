/* delotet_plc_add_triangles: markers given late start at zero; facets keep the order of addition. */
#include "test.h"

int main(void)
{
    static const uint32_t quad[4] = {0, 1, 3, 2}, wrong[6] = {0, 1, 2, 1, 2, 99};
    static const size_t end[1] = {4};
    double xyz[24];
    DelotetPlc *plc = NULL;
    DelotetError *error = NULL;
    box_points(xyz, 0, 1);
    OK(delotet_plc_new(xyz, 8, &plc, &error));
    OK(delotet_plc_add_triangles(plc, BOX, NULL, 4, &error));
    OK(delotet_plc_add_triangles(plc, BOX + 12, BOX_MARKERS + 4, 2, &error));
    OK(delotet_plc_add_triangles(plc, BOX + 18, NULL, 1, &error));
    OK(delotet_plc_add_facet(plc, quad, end, 1, 50, &error));
    OK(delotet_plc_add_triangles(plc, BOX + 21, BOX_MARKERS + 7, 5, &error));
    CHECK(delotet_plc_facet_count(plc) == 13);
    CHECK(delotet_plc_facet_marker(plc, 3) == 0 && delotet_plc_facet_marker(plc, 5) == 3);
    CHECK(delotet_plc_facet_marker(plc, 6) == 0 && delotet_plc_facet_marker(plc, 7) == 50);
    CHECK(delotet_plc_facet_marker(plc, 8) == 4 && delotet_plc_facet_marker(plc, 12) == 6);
    CHECK(delotet_plc_add_triangles(plc, wrong, NULL, 2, &error) == DELOTET_STATUS_INDEX_OUT_OF_RANGE);
    CHECK(DELOTET_AT(DelotetDefect, delotet_error_defects(error), 0)->first_element == DELOTET_ELEMENT_FACET);
    CHECK(DELOTET_AT(DelotetDefect, delotet_error_defects(error), 0)->first == 14);
    delotet_error_free(error);
    FAILS(INVALID, delotet_plc_add_triangles(plc, NULL, NULL, 1, &error));
    FAILS(INVALID, delotet_plc_add_triangles(plc, BOX, NULL, SIZE_MAX / 2, &error));
    FAILS(INVALID, delotet_plc_add_triangles(NULL, BOX, NULL, 1, &error));
    CHECK(delotet_plc_facet_count(plc) == 13);
    delotet_plc_free(plc);
    return 0;
}
