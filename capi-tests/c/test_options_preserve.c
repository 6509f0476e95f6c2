/* delotet_options_preserve: what was set; a refused value changes nothing. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    CHECK(delotet_options_preserve(options) == DELOTET_PRESERVE_ALL && delotet_options_preserve(NULL) == DELOTET_PRESERVE_ALL);
    OK(delotet_options_set_preserve(options, DELOTET_PRESERVE_OUTER, &error));
    CHECK(delotet_options_preserve(options) == DELOTET_PRESERVE_OUTER);
    FAILS(INVALID, delotet_options_set_preserve(options, 77, &error));
    CHECK(delotet_options_preserve(options) == DELOTET_PRESERVE_OUTER);
    delotet_options_free(options);
    return 0;
}
