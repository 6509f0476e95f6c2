/* delotet_write_options_region_name: the name of an attribute, NULL without one. */
#include "test.h"

int main(void)
{
    DelotetWriteOptions *options = delotet_write_options_new();
    CHECK(delotet_write_options_region_name(NULL, 1) == NULL);
    OK(delotet_write_options_set_region_name(options, 1, "steel", &error));
    OK(delotet_write_options_set_region_name(options, 2, "gr\xc3\xbc" "n", &error));
    CHECK(strcmp(delotet_write_options_region_name(options, 1), "steel") == 0);
    CHECK(strcmp(delotet_write_options_region_name(options, 2), "gr\xc3\xbc" "n") == 0);
    CHECK(delotet_write_options_region_name(options, 3) == NULL);
    delotet_write_options_free(options);
    return 0;
}
