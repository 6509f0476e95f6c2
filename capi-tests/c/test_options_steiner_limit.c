/* delotet_options_steiner_limit: what was set; UINT64_MAX stands for the default. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    CHECK(delotet_options_steiner_limit(options) == UINT64_MAX && delotet_options_steiner_limit(NULL) == UINT64_MAX);
    OK(delotet_options_set_steiner_limit(options, 0, &error));
    CHECK(delotet_options_steiner_limit(options) == 0);
    OK(delotet_options_set_steiner_limit(options, UINT64_MAX - 1, &error));
    CHECK(delotet_options_steiner_limit(options) == UINT64_MAX - 1);
    OK(delotet_options_set_steiner_limit(options, UINT64_MAX, &error));
    CHECK(delotet_options_steiner_limit(options) == UINT64_MAX);
    delotet_options_free(options);
    return 0;
}
