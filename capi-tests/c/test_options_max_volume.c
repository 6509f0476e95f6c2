/* delotet_options_max_volume: what was set; 0 if there is no bound; a refused value changes nothing and is named. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    CHECK(delotet_options_max_volume(options) == 0 && delotet_options_max_volume(NULL) == 0);
    OK(delotet_options_set_max_volume(options, 0.125, &error));
    CHECK(delotet_options_max_volume(options) == 0.125);
    OK(delotet_options_set_max_volume(options, 1e-300, &error));
    CHECK(delotet_options_max_volume(options) == 1e-300);
    {
        DelotetError *error = NULL;
        CHECK(delotet_options_set_max_volume(options, -3, &error) == INVALID);
        CHECK(strstr(delotet_error_message(error), "max_volume: -3") != NULL);
        delotet_error_free(error);
    }
    CHECK(delotet_options_max_volume(options) == 1e-300);
    OK(delotet_options_set_max_volume(options, 0, &error));
    CHECK(delotet_options_max_volume(options) == 0);
    delotet_options_free(options);
    return 0;
}
