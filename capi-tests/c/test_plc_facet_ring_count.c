/* delotet_plc_facet_ring_count: 1 for triangles, the number of rings for others. */
#include "test.h"

int main(void)
{
    static const uint32_t corners[7] = {0, 2, 3, 1, 4, 5, 6};
    static const size_t ends[2] = {4, 7};
    DelotetPlc *plc = cube();
    OK(delotet_plc_add_facet(plc, corners, ends, 2, 9, &error));
    CHECK(delotet_plc_facet_ring_count(plc, 0) == 1 && delotet_plc_facet_ring_count(plc, 12) == 2);
    CHECK(delotet_plc_facet_ring_count(plc, 13) == 0 && delotet_plc_facet_ring_count(NULL, 0) == 0);
    delotet_plc_free(plc);
    return 0;
}
