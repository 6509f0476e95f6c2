/* delotet_plc_regions: region seeds as they were given; no bound is 0. */
#include "test.h"

int main(void)
{
    static const double seeds[6] = {0.5, 0.5, 0.5, 2.5, 2.5, 2.5};
    DelotetPlc *plc = nested_boxes();
    const DelotetRegionSeed *second;
    CHECK(delotet_plc_regions(plc).count == 0);
    OK(delotet_plc_add_region(plc, seeds, 4, -1, &error));
    OK(delotet_plc_add_region(plc, seeds + 3, -2.5, 0.125, &error));
    CHECK(delotet_plc_regions(plc).count == 2 && delotet_plc_regions(plc).stride >= sizeof(DelotetRegionSeed));
    CHECK(DELOTET_AT(DelotetRegionSeed, delotet_plc_regions(plc), 0)->max_volume == 0);
    second = DELOTET_AT(DelotetRegionSeed, delotet_plc_regions(plc), 1);
    CHECK(second->attribute == -2.5 && second->max_volume == 0.125 && second->point[0] == 2.5 && second->point[2] == 2.5);
    CHECK(delotet_plc_regions(NULL).count == 0);
    delotet_plc_free(plc);
    return 0;
}
