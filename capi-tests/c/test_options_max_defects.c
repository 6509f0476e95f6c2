/* delotet_options_max_defects: what was set; 1000 by default. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    CHECK(delotet_options_max_defects(options) == 1000 && delotet_options_max_defects(NULL) == 1000);
    OK(delotet_options_set_max_defects(options, 0, &error));
    CHECK(delotet_options_max_defects(options) == 0);
    OK(delotet_options_set_max_defects(options, SIZE_MAX, &error));
    CHECK(delotet_options_max_defects(options) == SIZE_MAX);
    delotet_options_free(options);
    return 0;
}
