/* delotet_options_memory_limit: what was set; 0 stands for none. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    CHECK(delotet_options_memory_limit(options) == 0 && delotet_options_memory_limit(NULL) == 0);
    OK(delotet_options_set_memory_limit(options, UINT64_MAX, &error));
    CHECK(delotet_options_memory_limit(options) == UINT64_MAX);
    OK(delotet_options_set_memory_limit(options, 0, &error));
    CHECK(delotet_options_memory_limit(options) == 0);
    delotet_options_free(options);
    return 0;
}
