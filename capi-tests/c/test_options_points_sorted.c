/* delotet_options_points_sorted: what was set; off by default. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    CHECK(delotet_options_points_sorted(options) == false && delotet_options_points_sorted(NULL) == false);
    OK(delotet_options_set_points_sorted(options, true, &error));
    CHECK(delotet_options_points_sorted(options) == true);
    OK(delotet_options_set_points_sorted(options, false, &error));
    CHECK(delotet_options_points_sorted(options) == false);
    delotet_options_free(options);
    return 0;
}
