/* delotet_write_options_set_compress: on and off. */
#include "test.h"

int main(void)
{
    DelotetWriteOptions *options = delotet_write_options_new();
    OK(delotet_write_options_set_compress(options, true, &error));
    CHECK(delotet_write_options_compress(options));
    OK(delotet_write_options_set_compress(options, false, &error));
    CHECK(!delotet_write_options_compress(options));
    FAILS(INVALID, delotet_write_options_set_compress(NULL, true, &error));
    delotet_write_options_free(options);
    return 0;
}
