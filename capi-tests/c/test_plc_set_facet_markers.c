/* delotet_plc_set_facet_markers: all at once, triangles and others; NULL sets them to 0. */
#include "test.h"

int main(void)
{
    static const uint32_t square[4] = {0, 2, 3, 1};
    static const size_t end[1] = {4};
    int32_t markers[13];
    DelotetPlc *plc = cube();
    uint32_t i;
    OK(delotet_plc_add_polygons(plc, square, end, NULL, 1, &error));
    for (i = 0; i < 13; i++)
        markers[i] = 100 - (int32_t)i;
    OK(delotet_plc_set_facet_markers(plc, markers, &error));
    for (i = 0; i < 13; i++)
        CHECK(delotet_plc_facet_marker(plc, i) == 100 - (int32_t)i);
    OK(delotet_plc_set_facet_markers(plc, NULL, &error));
    for (i = 0; i < 13; i++)
        CHECK(delotet_plc_facet_marker(plc, i) == 0);
    FAILS(INVALID, delotet_plc_set_facet_markers(NULL, markers, &error));
    delotet_plc_free(plc);
    return 0;
}
