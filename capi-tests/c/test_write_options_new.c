/* delotet_write_options_new: options that the caller owns, with the defaults. */
#include "test.h"

int main(void)
{
    DelotetWriteOptions *options = delotet_write_options_new();
    CHECK(options != NULL);
    CHECK(!delotet_write_options_compress(options) && !delotet_write_options_second_order(options));
    CHECK(delotet_write_options_msh_version(options) == DELOTET_MSH_4_1);
    delotet_write_options_free(options);
    return 0;
}
