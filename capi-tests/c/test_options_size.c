/* delotet_options_size: what was set; 0 if there is none; a refused value changes nothing and is named. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    CHECK(delotet_options_size(options) == 0 && delotet_options_size(NULL) == 0);
    OK(delotet_options_set_size(options, 0.25, &error));
    CHECK(delotet_options_size(options) == 0.25);
    OK(delotet_options_set_size(options, 1e300, &error));
    CHECK(delotet_options_size(options) == 1e300);
    {
        DelotetError *error = NULL;
        CHECK(delotet_options_set_size(options, -3, &error) == INVALID);
        CHECK(strstr(delotet_error_message(error), "size: -3") != NULL);
        delotet_error_free(error);
    }
    CHECK(delotet_options_size(options) == 1e300);
    OK(delotet_options_set_size(options, 0, &error));
    CHECK(delotet_options_size(options) == 0);
    delotet_options_free(options);
    return 0;
}
