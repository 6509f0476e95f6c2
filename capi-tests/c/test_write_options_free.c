/* delotet_write_options_free: NULL is ignored; names that were set are freed with the options. */
#include "test.h"

int main(void)
{
    DelotetWriteOptions *options = delotet_write_options_new();
    OK(delotet_write_options_set_region_name(options, 1, "steel", &error));
    delotet_write_options_free(options);
    delotet_write_options_free(NULL);
    return 0;
}
