/* delotet_plc_marker_name_count: how many markers have names. */
#include "test.h"

int main(void)
{
    DelotetPlc *plc = cube();
    CHECK(delotet_plc_marker_name_count(plc) == 0 && delotet_plc_marker_name_count(NULL) == 0);
    OK(delotet_plc_set_marker_name(plc, 5, "five", &error));
    OK(delotet_plc_set_marker_name(plc, 5, "six", &error));
    CHECK(delotet_plc_marker_name_count(plc) == 1);
    delotet_plc_free(plc);
    return 0;
}
