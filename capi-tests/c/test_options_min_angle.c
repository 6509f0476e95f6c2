/* delotet_options_min_angle: what was set, in degrees; 0 at first; a refused value changes nothing. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    CHECK(delotet_options_min_angle(options) == 0 && delotet_options_min_angle(NULL) == 0);
    OK(delotet_options_set_min_angle(options, 17.5, &error));
    CHECK(delotet_options_min_angle(options) == 17.5 && delotet_options_optimize(options) == 0);
    FAILS(INVALID, delotet_options_set_min_angle(options, 60.5, &error));
    CHECK(delotet_options_min_angle(options) == 17.5);
    OK(delotet_options_set_min_angle(options, 60, &error));
    OK(delotet_options_set_min_angle(options, 0, &error));
    CHECK(delotet_options_min_angle(options) == 0);
    delotet_options_free(options);
    return 0;
}
