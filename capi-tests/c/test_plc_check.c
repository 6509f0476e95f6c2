/* delotet_plc_check: good input passes, bad input is named, progress may cancel. */
#include "test.h"

static int32_t stop(void *user_data, DelotetPhase phase, double fraction)
{
    (void)user_data, (void)phase, (void)fraction;
    return 1;
}

int main(void)
{
    DelotetPlc *good = cube(), *bad = pierced();
    DelotetOptions *options = delotet_options_new();
    OK(delotet_plc_check(good, NULL, &error));
    OK(delotet_plc_check(good, options, &error));
    FAILS(DELOTET_STATUS_SELF_INTERSECTION, delotet_plc_check(bad, NULL, &error));
    CHECK(delotet_plc_check(bad, NULL, NULL) == DELOTET_STATUS_SELF_INTERSECTION);
    FAILS(INVALID, delotet_plc_check(NULL, NULL, &error));
    OK(delotet_options_set_progress(options, stop, NULL, &error));
    FAILS(DELOTET_STATUS_CANCELLED, delotet_plc_check(good, options, &error));
    delotet_options_free(options);
    delotet_plc_free(good);
    delotet_plc_free(bad);
    return 0;
}
