/* delotet_write_options_msh_version: 4.1 by default, else what was set. */
#include "test.h"

int main(void)
{
    DelotetWriteOptions *options = delotet_write_options_new();
    CHECK(delotet_write_options_msh_version(NULL) == DELOTET_MSH_4_1);
    OK(delotet_write_options_set_msh_version(options, DELOTET_MSH_2_2, &error));
    CHECK(delotet_write_options_msh_version(options) == DELOTET_MSH_2_2);
    delotet_write_options_free(options);
    return 0;
}
