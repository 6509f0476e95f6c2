/* delotet_write_options_set_quality_data: on and off. */
#include "test.h"

int main(void)
{
    DelotetWriteOptions *options = delotet_write_options_new();
    OK(delotet_write_options_set_quality_data(options, true, &error));
    CHECK(delotet_write_options_quality_data(options));
    OK(delotet_write_options_set_quality_data(options, false, &error));
    CHECK(!delotet_write_options_quality_data(options));
    FAILS(INVALID, delotet_write_options_set_quality_data(NULL, true, &error));
    delotet_write_options_free(options);
    return 0;
}
