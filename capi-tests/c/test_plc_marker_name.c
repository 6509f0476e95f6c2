/* delotet_plc_marker_name: by marker; NULL for those that have none. */
#include "test.h"

int main(void)
{
    DelotetPlc *plc = cube();
    OK(delotet_plc_set_marker_name(plc, 5, "five", &error));
    OK(delotet_plc_set_marker_name(plc, -3, "minus three", &error));
    CHECK(strcmp(delotet_plc_marker_name(plc, 5), "five") == 0);
    CHECK(strcmp(delotet_plc_marker_name(plc, -3), "minus three") == 0);
    CHECK(delotet_plc_marker_name(plc, 4) == NULL && delotet_plc_marker_name(NULL, 5) == NULL);
    delotet_plc_free(plc);
    return 0;
}
