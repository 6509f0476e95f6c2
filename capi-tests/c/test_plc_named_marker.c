/* delotet_plc_named_marker: the markers that have names, ascending. */
#include "test.h"

int main(void)
{
    DelotetPlc *plc = cube();
    OK(delotet_plc_set_marker_name(plc, 5, "five", &error));
    OK(delotet_plc_set_marker_name(plc, -3, "minus three", &error));
    CHECK(delotet_plc_marker_name_count(plc) == 2);
    CHECK(delotet_plc_named_marker(plc, 0) == -3 && delotet_plc_named_marker(plc, 1) == 5);
    CHECK(delotet_plc_named_marker(plc, 2) == 0 && delotet_plc_named_marker(NULL, 0) == 0);
    delotet_plc_free(plc);
    return 0;
}
