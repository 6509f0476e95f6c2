/* delotet_options_threads: what was set; a refused value changes nothing. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    CHECK(delotet_options_threads(options) == 1 && delotet_options_threads(NULL) == 1);
    OK(delotet_options_set_threads(options, 7, &error));
    CHECK(delotet_options_threads(options) == 7);
    delotet_options_free(options);
    return 0;
}
