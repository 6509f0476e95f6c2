/* delotet_options_merge_facets: what was set; 0 if merging is off; a refused value changes nothing and is named. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    CHECK(delotet_options_merge_facets(options) == 0 && delotet_options_merge_facets(NULL) == 0);
    OK(delotet_options_set_merge_facets(options, 175.5, &error));
    CHECK(delotet_options_merge_facets(options) == 175.5);
    OK(delotet_options_set_merge_facets(options, 90, &error));
    CHECK(delotet_options_merge_facets(options) == 90);
    {
        DelotetError *error = NULL;
        CHECK(delotet_options_set_merge_facets(options, 17.5, &error) == INVALID);
        CHECK(strstr(delotet_error_message(error), "merge_facets: 17.5") != NULL);
        delotet_error_free(error);
    }
    CHECK(delotet_options_merge_facets(options) == 90);
    OK(delotet_options_set_merge_facets(options, 0, &error));
    CHECK(delotet_options_merge_facets(options) == 0);
    delotet_options_free(options);
    return 0;
}
