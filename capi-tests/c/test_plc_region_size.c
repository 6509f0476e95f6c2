/* delotet_plc_region_size: that of regions with an attribute; infinite without a wish; copies have it. */
#include "test.h"

int main(void)
{
    DelotetPlc *plc = nested_boxes(), *copy = NULL;
    CHECK(isinf(delotet_plc_region_size(plc, 2.5)) && isinf(delotet_plc_region_size(NULL, 2.5)));
    OK(delotet_plc_set_region_size(plc, 2.5, 0.5, &error));
    OK(delotet_plc_set_region_size(plc, -3, 2, &error));
    OK(delotet_plc_clone(plc, &copy, &error));
    delotet_plc_free(plc);
    CHECK(delotet_plc_region_size(copy, 2.5) == 0.5 && delotet_plc_region_size(copy, -3) == 2);
    CHECK(isinf(delotet_plc_region_size(copy, 7)) && delotet_plc_region_size(copy, 7) > 0);
    delotet_plc_free(copy);
    return 0;
}
