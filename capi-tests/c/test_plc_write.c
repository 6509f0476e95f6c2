/* delotet_plc_write: what is written reads back the same; what a format cannot hold is refused. */
#include "test.h"

int main(void)
{
    static const double seed[3] = {0.5, 0.5, 0.5};
    static const char *const names[5] = {"plc_write.off", "plc_write.stl", "plc_write.obj", "plc_write.ply", "plc_write.smesh"};
    DelotetPlc *plc = cube(), *back = NULL;
    uint32_t facet;
    size_t i;
    for (i = 0; i < 5; i++) {
        OK(delotet_plc_write(plc, names[i], &error));
        OK(delotet_plc_read(names[i], &back, &error));
        CHECK(delotet_plc_points(back).count == 8 && delotet_plc_facet_count(back) == 12);
        delotet_plc_free(back);
        CHECK(remove(names[i]) == 0);
    }
    OK(delotet_plc_add_region(plc, seed, 2.5, 0.5, &error));
    OK(delotet_plc_add_segment(plc, 0, 7, 3, &error));
    OK(delotet_plc_write(plc, "plc_write.poly", &error));
    OK(delotet_plc_read("plc_write.poly", &back, &error));
    CHECK(memcmp(delotet_plc_points(back).data, delotet_plc_points(plc).data, 24 * sizeof(double)) == 0);
    for (facet = 0; facet < 12; facet++) {
        CHECK(delotet_plc_facet_marker(back, facet) == BOX_MARKERS[facet]);
        CHECK(memcmp(delotet_plc_facet_ring(back, facet, 0).data, BOX + 3 * facet, 12) == 0);
    }
    CHECK(delotet_plc_segment_count(back) == 1 && DELOTET_AT(DelotetSegment, delotet_plc_segments(back), 0)->marker == 3);
    CHECK(DELOTET_AT(DelotetRegionSeed, delotet_plc_regions(back), 0)->attribute == 2.5);
    CHECK(DELOTET_AT(DelotetRegionSeed, delotet_plc_regions(back), 0)->max_volume == 0.5);
    delotet_plc_free(back);
    CHECK(remove("plc_write.poly") == 0);
    FAILS(DELOTET_STATUS_UNSUPPORTED, delotet_plc_write(plc, "plc_write.nonsense", &error));
    FAILS(DELOTET_STATUS_UNSUPPORTED, delotet_plc_write(plc, "plc_write.vtu", &error));
    FAILS(DELOTET_STATUS_FILE, delotet_plc_write(plc, "no/such/folder/plc_write.poly", &error));
    FAILS(INVALID, delotet_plc_write(NULL, "plc_write.off", &error));
    FAILS(INVALID, delotet_plc_write(plc, NULL, &error));
    delotet_plc_free(plc);
    return 0;
}
