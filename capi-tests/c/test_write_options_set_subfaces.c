/* delotet_write_options_set_subfaces: on and off. */
#include "test.h"

int main(void)
{
    DelotetWriteOptions *options = delotet_write_options_new();
    OK(delotet_write_options_set_subfaces(options, true, &error));
    CHECK(delotet_write_options_subfaces(options));
    OK(delotet_write_options_set_subfaces(options, false, &error));
    CHECK(!delotet_write_options_subfaces(options));
    FAILS(INVALID, delotet_write_options_set_subfaces(NULL, true, &error));
    delotet_write_options_free(options);
    return 0;
}
