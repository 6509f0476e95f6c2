/* delotet_options_mode: what was set; a refused value changes nothing. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    CHECK(delotet_options_mode(options) == DELOTET_MODE_CONSTRAINED && delotet_options_mode(NULL) == DELOTET_MODE_CONSTRAINED);
    OK(delotet_options_set_mode(options, DELOTET_MODE_DELAUNAY, &error));
    CHECK(delotet_options_mode(options) == DELOTET_MODE_DELAUNAY);
    OK(delotet_options_set_mode(options, DELOTET_MODE_PRESERVE, &error));
    CHECK(delotet_options_mode(options) == DELOTET_MODE_PRESERVE);
    FAILS(INVALID, delotet_options_set_mode(options, 77, &error));
    CHECK(delotet_options_mode(options) == DELOTET_MODE_PRESERVE);
    delotet_options_free(options);
    return 0;
}
