/* delotet_write_options_time_limit: what was set; 0 stands for none. */
#include "test.h"

int main(void)
{
    DelotetWriteOptions *options = delotet_write_options_new();
    CHECK(!(delotet_write_options_time_limit(options) > 0) && !(delotet_write_options_time_limit(NULL) > 0));
    OK(delotet_write_options_set_time_limit(options, 2.5, &error));
    CHECK(near(delotet_write_options_time_limit(options), 2.5));
    OK(delotet_write_options_set_time_limit(options, 1e-300, &error));
    CHECK(delotet_write_options_time_limit(options) > 0);
    OK(delotet_write_options_set_time_limit(options, 0, &error));
    CHECK(!(delotet_write_options_time_limit(options) > 0));
    delotet_write_options_free(options);
    return 0;
}
