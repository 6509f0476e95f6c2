/* delotet_options_optimize_seconds: what was set; 0 at first. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    CHECK(delotet_options_optimize_seconds(options) == 0 && delotet_options_optimize_seconds(NULL) == 0);
    OK(delotet_options_set_optimize_seconds(options, 0.5, &error));
    CHECK(delotet_options_optimize_seconds(options) == 0.5 && delotet_options_optimize(options) == 0);
    OK(delotet_options_set_optimize_seconds(options, 0, &error));
    CHECK(delotet_options_optimize_seconds(options) == 0);
    delotet_options_free(options);
    return 0;
}
