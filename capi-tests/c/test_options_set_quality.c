/* delotet_options_set_quality: 0, or a ratio of at least 1.2, for which points are added; the surface is kept. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = grid_box();
    size_t none;
    OK(delotet_options_set_mode(options, DELOTET_MODE_PRESERVE, &error));
    none = points_in_grid(plc, options);
    OK(delotet_options_set_quality(options, 1.2, &error));
    OK(delotet_options_set_quality(options, 2, &error));
    CHECK(none < points_in_grid(plc, options));
    FAILS(INVALID, delotet_options_set_quality(options, 1.1999, &error));
    FAILS(INVALID, delotet_options_set_quality(options, 1e-300, &error));
    FAILS(INVALID, delotet_options_set_quality(options, -2, &error));
    FAILS(INVALID, delotet_options_set_quality(options, NAN, &error));
    FAILS(INVALID, delotet_options_set_quality(options, INFINITY, &error));
    FAILS(INVALID, delotet_options_set_quality(NULL, 2, &error));
    delotet_plc_free(plc);
    delotet_options_free(options);
    return 0;
}
