/* delotet_write_options_subfaces: off by default, else what was set. */
#include "test.h"

int main(void)
{
    DelotetWriteOptions *options = delotet_write_options_new();
    CHECK(!delotet_write_options_subfaces(options) && !delotet_write_options_subfaces(NULL));
    OK(delotet_write_options_set_subfaces(options, true, &error));
    CHECK(delotet_write_options_subfaces(options));
    delotet_write_options_free(options);
    return 0;
}
