/* delotet_options_tetrahedra_limit: what was set; UINT64_MAX stands for no limit. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    CHECK(delotet_options_tetrahedra_limit(options) == UINT64_MAX && delotet_options_tetrahedra_limit(NULL) == UINT64_MAX);
    OK(delotet_options_set_tetrahedra_limit(options, 0, &error));
    CHECK(delotet_options_tetrahedra_limit(options) == 0);
    OK(delotet_options_set_tetrahedra_limit(options, UINT64_MAX - 1, &error));
    CHECK(delotet_options_tetrahedra_limit(options) == UINT64_MAX - 1);
    OK(delotet_options_set_tetrahedra_limit(options, UINT64_MAX, &error));
    CHECK(delotet_options_tetrahedra_limit(options) == UINT64_MAX);
    delotet_options_free(options);
    return 0;
}
