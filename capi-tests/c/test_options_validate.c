/* delotet_options_validate: what was set; on by default. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    CHECK(delotet_options_validate(options) == true && delotet_options_validate(NULL) == true);
    OK(delotet_options_set_validate(options, false, &error));
    CHECK(delotet_options_validate(options) == false);
    OK(delotet_options_set_validate(options, true, &error));
    CHECK(delotet_options_validate(options) == true);
    delotet_options_free(options);
    return 0;
}
