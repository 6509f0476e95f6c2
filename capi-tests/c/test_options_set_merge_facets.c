/* delotet_options_set_merge_facets: angles from 90 to 180 degrees, or 0. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    OK(delotet_options_set_merge_facets(options, 179.9, &error));
    OK(delotet_options_set_merge_facets(options, 90, &error));
    OK(delotet_options_set_merge_facets(options, 180, &error));
    OK(delotet_options_set_merge_facets(options, 0, &error));
    FAILS(INVALID, delotet_options_set_merge_facets(options, 89.9, &error));
    FAILS(INVALID, delotet_options_set_merge_facets(options, 180.5, &error));
    FAILS(INVALID, delotet_options_set_merge_facets(options, -1, &error));
    FAILS(INVALID, delotet_options_set_merge_facets(options, NAN, &error));
    FAILS(INVALID, delotet_options_set_merge_facets(options, INFINITY, &error));
    FAILS(INVALID, delotet_options_set_merge_facets(NULL, 0, &error));
    delotet_options_free(options);
    return 0;
}
