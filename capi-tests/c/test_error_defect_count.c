/* delotet_error_defect_count: also counts defects that are not listed. */
#include "test.h"

int main(void)
{
    DelotetPlc *plc = NULL;
    DelotetOptions *options = delotet_options_new();
    DelotetError *error = NULL;
    double xyz[30];
    int i;
    for (i = 0; i < 30; i++)
        xyz[i] = i % 3 == 0 ? (double)NAN : i;
    OK(delotet_plc_new(xyz, 10, &plc, &error));
    OK(delotet_options_set_max_defects(options, 3, &error));
    CHECK(delotet_plc_check(plc, options, &error) == DELOTET_STATUS_NON_FINITE_POINT);
    CHECK(delotet_error_defects(error).count == 3);
    CHECK(delotet_error_defect_count(error) == 10);
    CHECK(DELOTET_AT(DelotetDefect, delotet_error_defects(error), 2)->first_element == DELOTET_ELEMENT_POINT);
    CHECK(delotet_error_defect_count(NULL) == 0);
    delotet_error_free(error);
    delotet_options_free(options);
    delotet_plc_free(plc);
    return 0;
}
