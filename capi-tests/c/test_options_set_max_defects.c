/* delotet_options_set_max_defects: the list is truncated, the count is not. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = NULL;
    DelotetError *error = NULL;
    double xyz[12] = {NAN, 0, 0, 1, NAN, 0, 0, 1, NAN, 0, INFINITY, 1};
    OK(delotet_plc_new(xyz, 4, &plc, &error));
    OK(delotet_options_set_max_defects(options, 2, &error));
    CHECK(delotet_plc_check(plc, options, &error) == DELOTET_STATUS_NON_FINITE_POINT);
    CHECK(delotet_error_defects(error).count == 2 && delotet_error_defect_count(error) == 4);
    delotet_error_free(error);
    OK(delotet_options_set_max_defects(options, 0, &error));
    CHECK(delotet_plc_check(plc, options, &error) == DELOTET_STATUS_NON_FINITE_POINT);
    CHECK(delotet_error_defects(error).count == 0 && delotet_error_defects(error).first == NULL);
    delotet_error_free(error);
    FAILS(INVALID, delotet_options_set_max_defects(NULL, 1, &error));
    delotet_plc_free(plc);
    delotet_options_free(options);
    return 0;
}
