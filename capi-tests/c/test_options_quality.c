/* delotet_options_quality: what was set; 0 if there is no bound; a refused value changes nothing and is named. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    CHECK(delotet_options_quality(options) == 0 && delotet_options_quality(NULL) == 0);
    OK(delotet_options_set_quality(options, 1, &error));
    CHECK(delotet_options_quality(options) == 1);
    OK(delotet_options_set_quality(options, 2, &error));
    CHECK(delotet_options_quality(options) == 2);
    {
        DelotetError *error = NULL;
        CHECK(delotet_options_set_quality(options, 0.875, &error) == INVALID);
        CHECK(strstr(delotet_error_message(error), "quality: 0.875") != NULL);
        delotet_error_free(error);
    }
    CHECK(delotet_options_quality(options) == 2);
    OK(delotet_options_set_quality(options, 0, &error));
    CHECK(delotet_options_quality(options) == 0);
    delotet_options_free(options);
    return 0;
}
