/* delotet_plc_set_region_size: set, replaced, removed; what is no length is refused and changes nothing; a wish for filling. */
#include "test.h"

int main(void)
{
    static const double seed[3] = {1.5, 1.5, 1.5};
    DelotetPlc *plc = grid_box();
    DelotetOptions *options = delotet_options_new();
    size_t none;
    OK(delotet_plc_add_region(plc, seed, 2.5, 0, &error));
    OK(delotet_options_set_mode(options, DELOTET_MODE_PRESERVE, &error));
    OK(delotet_options_set_size(options, 3, &error));
    none = points_in_grid(plc, options);
    OK(delotet_plc_set_region_size(plc, 2.5, 2, &error));
    OK(delotet_plc_set_region_size(plc, 2.5, 0.25, &error));
    FAILS(INVALID, delotet_plc_set_region_size(plc, 2.5, 0, &error));
    FAILS(INVALID, delotet_plc_set_region_size(plc, 2.5, -1, &error));
    FAILS(INVALID, delotet_plc_set_region_size(plc, 2.5, -INFINITY, &error));
    FAILS(INVALID, delotet_plc_set_region_size(plc, 2.5, NAN, &error));
    FAILS(INVALID, delotet_plc_set_region_size(plc, NAN, 1, &error));
    FAILS(INVALID, delotet_plc_set_region_size(NULL, 2.5, 1, &error));
    CHECK(delotet_plc_region_size(plc, 2.5) == 0.25);
    CHECK(points_in_grid(plc, options) > none);
    OK(delotet_plc_set_region_size(plc, 2.5, INFINITY, &error));
    CHECK(isinf(delotet_plc_region_size(plc, 2.5)) && points_in_grid(plc, options) == none);
    delotet_plc_free(plc);
    delotet_options_free(options);
    return 0;
}
