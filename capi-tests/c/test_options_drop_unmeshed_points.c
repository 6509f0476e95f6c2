/* delotet_options_drop_unmeshed_points: what was set; off by default. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    CHECK(delotet_options_drop_unmeshed_points(options) == false && delotet_options_drop_unmeshed_points(NULL) == false);
    OK(delotet_options_set_drop_unmeshed_points(options, true, &error));
    CHECK(delotet_options_drop_unmeshed_points(options) == true);
    OK(delotet_options_set_drop_unmeshed_points(options, false, &error));
    CHECK(delotet_options_drop_unmeshed_points(options) == false);
    delotet_options_free(options);
    return 0;
}
