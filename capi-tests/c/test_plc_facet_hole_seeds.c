/* delotet_plc_facet_hole_seeds: the seeds of one facet. */
#include "test.h"

int main(void)
{
    static const uint32_t corners[7] = {0, 2, 3, 1, 4, 5, 6};
    static const size_t ends[2] = {4, 7};
    DelotetPlc *plc = cube();
    static const double seeds[6] = {0.5, 0.25, 0, 0.75, 0.5, 0};
    OK(delotet_plc_add_facet(plc, corners, ends, 2, 9, &error));
    OK(delotet_plc_add_facet_with_hole_seeds(plc, corners, ends, 2, seeds, 2, 9, &error));
    CHECK(delotet_plc_facet_hole_seeds(plc, 0).count == 0 && delotet_plc_facet_hole_seeds(plc, 12).count == 0);
    CHECK(delotet_plc_facet_hole_seeds(plc, 13).count == 2);
    CHECK(memcmp(delotet_plc_facet_hole_seeds(plc, 13).data, seeds, sizeof seeds) == 0);
    CHECK(delotet_plc_facet_hole_seeds(plc, 14).data == NULL && delotet_plc_facet_hole_seeds(NULL, 0).count == 0);
    delotet_plc_free(plc);
    return 0;
}
