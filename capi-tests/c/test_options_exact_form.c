/* delotet_options_exact_form: what was set; off by default. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    CHECK(delotet_options_exact_form(options) == false && delotet_options_exact_form(NULL) == false);
    OK(delotet_options_set_exact_form(options, true, &error));
    CHECK(delotet_options_exact_form(options) == true);
    OK(delotet_options_set_exact_form(options, false, &error));
    CHECK(delotet_options_exact_form(options) == false);
    delotet_options_free(options);
    return 0;
}
