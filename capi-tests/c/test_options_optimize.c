/* delotet_options_optimize: what was set; 0 at first. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    CHECK(delotet_options_optimize(options) == 0 && delotet_options_optimize(NULL) == 0);
    OK(delotet_options_set_optimize(options, 1, &error));
    CHECK(delotet_options_optimize(options) == 1);
    OK(delotet_options_set_optimize(options, UINT32_MAX, &error));
    CHECK(delotet_options_optimize(options) == UINT32_MAX);
    OK(delotet_options_set_optimize(options, 0, &error));
    CHECK(delotet_options_optimize(options) == 0);
    delotet_options_free(options);
    return 0;
}
