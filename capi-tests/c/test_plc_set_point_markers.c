/* delotet_plc_set_point_markers: copied, replaced, removed. */
#include "test.h"

int main(void)
{
    int32_t markers[8] = {1, -2, 3, INT32_MAX, INT32_MIN, 6, 7, 8};
    DelotetPlc *plc = cube();
    OK(delotet_plc_set_point_markers(plc, markers, &error));
    markers[1] = 0;
    CHECK(delotet_plc_point_markers(plc).count == 8 && delotet_plc_point_markers(plc).data[1] == -2);
    OK(delotet_plc_set_point_markers(plc, NULL, &error));
    CHECK(delotet_plc_point_markers(plc).count == 0);
    FAILS(INVALID, delotet_plc_set_point_markers(NULL, markers, &error));
    delotet_plc_free(plc);
    return 0;
}
