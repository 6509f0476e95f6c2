/* delotet_plc_set_facet_area: set, replaced, removed; what is no area is refused and changes nothing; a wish for filling. */
#include "test.h"

int main(void)
{
    DelotetPlc *plc = grid_box();
    DelotetOptions *options = delotet_options_new();
    size_t none;
    OK(delotet_options_set_mode(options, DELOTET_MODE_PRESERVE, &error));
    OK(delotet_options_set_size(options, 3, &error));
    none = points_in_grid(plc, options);
    OK(delotet_plc_set_facet_area(plc, 1, 2, &error));
    OK(delotet_plc_set_facet_area(plc, 1, 0.0625, &error));
    FAILS(INVALID, delotet_plc_set_facet_area(plc, 1, 0, &error));
    FAILS(INVALID, delotet_plc_set_facet_area(plc, 1, -1, &error));
    FAILS(INVALID, delotet_plc_set_facet_area(plc, 1, -INFINITY, &error));
    FAILS(INVALID, delotet_plc_set_facet_area(plc, 1, NAN, &error));
    FAILS(INVALID, delotet_plc_set_facet_area(NULL, 1, 1, &error));
    CHECK(delotet_plc_facet_area(plc, 1) == 0.0625);
    CHECK(points_in_grid(plc, options) > none);
    OK(delotet_plc_set_facet_area(plc, 1, INFINITY, &error));
    CHECK(isinf(delotet_plc_facet_area(plc, 1)) && points_in_grid(plc, options) == none);
    delotet_plc_free(plc);
    delotet_options_free(options);
    return 0;
}
