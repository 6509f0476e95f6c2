/* delotet_plc_facet_ring: the corners of every ring as they were given. */
#include "test.h"

int main(void)
{
    static const uint32_t corners[7] = {0, 2, 3, 1, 4, 5, 6};
    static const size_t ends[2] = {4, 7};
    DelotetPlc *plc = cube();
    DelotetIndicesView ring;
    uint32_t facet;
    OK(delotet_plc_add_facet(plc, corners, ends, 2, 9, &error));
    for (facet = 0; facet < 12; facet++) {
        ring = delotet_plc_facet_ring(plc, facet, 0);
        CHECK(ring.count == 3 && memcmp(ring.data, BOX + 3 * facet, 12) == 0);
        CHECK(delotet_plc_facet_ring(plc, facet, 1).count == 0);
    }
    ring = delotet_plc_facet_ring(plc, 12, 0);
    CHECK(ring.count == 4 && memcmp(ring.data, corners, 16) == 0);
    ring = delotet_plc_facet_ring(plc, 12, 1);
    CHECK(ring.count == 3 && memcmp(ring.data, corners + 4, 12) == 0);
    CHECK(delotet_plc_facet_ring(plc, 12, 2).data == NULL && delotet_plc_facet_ring(plc, 13, 0).count == 0);
    CHECK(delotet_plc_facet_ring(NULL, 0, 0).count == 0);
    delotet_plc_free(plc);
    return 0;
}
