/* delotet_write_options_quality_data: off by default, else what was set. */
#include "test.h"

int main(void)
{
    DelotetWriteOptions *options = delotet_write_options_new();
    CHECK(!delotet_write_options_quality_data(options) && !delotet_write_options_quality_data(NULL));
    OK(delotet_write_options_set_quality_data(options, true, &error));
    CHECK(delotet_write_options_quality_data(options));
    delotet_write_options_free(options);
    return 0;
}
