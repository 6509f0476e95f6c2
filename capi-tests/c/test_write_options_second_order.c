/* delotet_write_options_second_order: off by default, else what was set. */
#include "test.h"

int main(void)
{
    DelotetWriteOptions *options = delotet_write_options_new();
    CHECK(!delotet_write_options_second_order(options) && !delotet_write_options_second_order(NULL));
    OK(delotet_write_options_set_second_order(options, true, &error));
    CHECK(delotet_write_options_second_order(options));
    delotet_write_options_free(options);
    return 0;
}
