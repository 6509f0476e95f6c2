/* delotet_write_options_set_msh_version: two versions and no other; a refused value changes nothing. */
#include "test.h"

int main(void)
{
    DelotetWriteOptions *options = delotet_write_options_new();
    OK(delotet_write_options_set_msh_version(options, DELOTET_MSH_2_2, &error));
    FAILS(INVALID, delotet_write_options_set_msh_version(options, 3, &error));
    CHECK(delotet_write_options_msh_version(options) == DELOTET_MSH_2_2);
    OK(delotet_write_options_set_msh_version(options, DELOTET_MSH_4_1, &error));
    FAILS(INVALID, delotet_write_options_set_msh_version(NULL, DELOTET_MSH_2_2, &error));
    delotet_write_options_free(options);
    return 0;
}
