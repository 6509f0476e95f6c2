/* delotet_options_set_merge_facets: angles from 90 to 180 degrees, or 0. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    CHECK(delotet_options_set_merge_facets(options, 179.9) == DELOTET_STATUS_OK);
    CHECK(delotet_options_set_merge_facets(options, 90) == DELOTET_STATUS_OK);
    CHECK(delotet_options_set_merge_facets(options, 180) == DELOTET_STATUS_OK);
    CHECK(delotet_options_set_merge_facets(options, 0) == DELOTET_STATUS_OK);
    CHECK(delotet_options_set_merge_facets(options, 89.9) == INVALID);
    CHECK(delotet_options_set_merge_facets(options, 180.5) == INVALID);
    CHECK(delotet_options_set_merge_facets(options, -1) == INVALID);
    CHECK(delotet_options_set_merge_facets(options, NAN) == INVALID);
    CHECK(delotet_options_set_merge_facets(options, INFINITY) == INVALID);
    CHECK(delotet_options_set_merge_facets(NULL, 0) == INVALID);
    delotet_options_free(options);
    return 0;
}
