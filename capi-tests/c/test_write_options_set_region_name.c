/* delotet_write_options_set_region_name: names are copied, replaced and removed. */
#include "test.h"

int main(void)
{
    DelotetWriteOptions *options = delotet_write_options_new();
    char name[8] = "steel";
    OK(delotet_write_options_set_region_name(options, 2.5, name, &error));
    name[0] = 'x';
    CHECK(strcmp(delotet_write_options_region_name(options, 2.5), "steel") == 0);
    OK(delotet_write_options_set_region_name(options, 2.5, "copper", &error));
    CHECK(strcmp(delotet_write_options_region_name(options, 2.5), "copper") == 0);
    OK(delotet_write_options_set_region_name(options, 2.5, NULL, &error));
    CHECK(delotet_write_options_region_name(options, 2.5) == NULL);
    FAILS(INVALID, delotet_write_options_set_region_name(options, NAN, "steel", &error));
    FAILS(INVALID, delotet_write_options_set_region_name(options, 1, "\xff", &error));
    FAILS(INVALID, delotet_write_options_set_region_name(NULL, 1, "steel", &error));
    delotet_write_options_free(options);
    return 0;
}
