/* delotet_options_keep_hull: what was set; off by default. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    CHECK(delotet_options_keep_hull(options) == false && delotet_options_keep_hull(NULL) == false);
    OK(delotet_options_set_keep_hull(options, true, &error));
    CHECK(delotet_options_keep_hull(options) == true);
    OK(delotet_options_set_keep_hull(options, false, &error));
    CHECK(delotet_options_keep_hull(options) == false);
    delotet_options_free(options);
    return 0;
}
