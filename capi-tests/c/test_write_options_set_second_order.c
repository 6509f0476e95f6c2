/* delotet_write_options_set_second_order: on and off. */
#include "test.h"

int main(void)
{
    DelotetWriteOptions *options = delotet_write_options_new();
    OK(delotet_write_options_set_second_order(options, true, &error));
    CHECK(delotet_write_options_second_order(options));
    OK(delotet_write_options_set_second_order(options, false, &error));
    CHECK(!delotet_write_options_second_order(options));
    FAILS(INVALID, delotet_write_options_set_second_order(NULL, true, &error));
    delotet_write_options_free(options);
    return 0;
}
