/* delotet_plc_holes: hole seeds as they were given. */
#include "test.h"

int main(void)
{
    static const double seeds[6] = {1.5, 1.5, 1.5, 9, 8, 7};
    DelotetPlc *plc = cube();
    CHECK(delotet_plc_holes(plc).count == 0);
    OK(delotet_plc_add_hole(plc, seeds, &error));
    OK(delotet_plc_add_hole(plc, seeds + 3, &error));
    CHECK(delotet_plc_holes(plc).count == 2);
    CHECK(memcmp(delotet_plc_holes(plc).data, seeds, sizeof seeds) == 0);
    CHECK(delotet_plc_holes(NULL).data == NULL);
    delotet_plc_free(plc);
    return 0;
}
