/* delotet_options_gradation: what was set; a refused value changes nothing and is named. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    CHECK(delotet_options_gradation(options) == 0.3 && delotet_options_gradation(NULL) == 0.3);
    OK(delotet_options_set_gradation(options, 1, &error));
    CHECK(delotet_options_gradation(options) == 1);
    OK(delotet_options_set_gradation(options, 0.125, &error));
    CHECK(delotet_options_gradation(options) == 0.125);
    {
        DelotetError *error = NULL;
        CHECK(delotet_options_set_gradation(options, 1.5, &error) == INVALID);
        CHECK(strstr(delotet_error_message(error), "gradation: 1.5") != NULL);
        delotet_error_free(error);
    }
    CHECK(delotet_options_gradation(options) == 0.125);
    OK(delotet_options_set_gradation(options, 0.3, &error));
    CHECK(delotet_options_gradation(options) == 0.3);
    delotet_options_free(options);
    return 0;
}
