/* delotet_write_options_compress: off by default, else what was set. */
#include "test.h"

int main(void)
{
    DelotetWriteOptions *options = delotet_write_options_new();
    CHECK(!delotet_write_options_compress(options) && !delotet_write_options_compress(NULL));
    OK(delotet_write_options_set_compress(options, true, &error));
    CHECK(delotet_write_options_compress(options));
    delotet_write_options_free(options);
    return 0;
}
