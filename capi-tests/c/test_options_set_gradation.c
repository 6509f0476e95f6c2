/* delotet_options_set_gradation: above 0, at most 1; sizes that grow faster inwards need fewer points. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = grid_box();
    size_t slow;
    OK(delotet_options_set_mode(options, DELOTET_MODE_PRESERVE, &error));
    OK(delotet_options_set_quality(options, 2, &error));
    OK(delotet_options_set_gradation(options, 1e-3, &error));
    slow = points_in_grid(plc, options);
    OK(delotet_options_set_gradation(options, 1, &error));
    CHECK(points_in_grid(plc, options) < slow);
    FAILS(INVALID, delotet_options_set_gradation(options, 0, &error));
    FAILS(INVALID, delotet_options_set_gradation(options, -0.5, &error));
    FAILS(INVALID, delotet_options_set_gradation(options, 1.001, &error));
    FAILS(INVALID, delotet_options_set_gradation(options, NAN, &error));
    FAILS(INVALID, delotet_options_set_gradation(options, INFINITY, &error));
    FAILS(INVALID, delotet_options_set_gradation(NULL, 0.5, &error));
    delotet_plc_free(plc);
    delotet_options_free(options);
    return 0;
}
