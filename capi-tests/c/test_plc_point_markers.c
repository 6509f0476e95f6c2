/* delotet_plc_point_markers: empty unless set. */
#include "test.h"

int main(void)
{
    static const int32_t markers[8] = {8, 7, 6, 5, 4, 3, 2, 1};
    DelotetPlc *plc = cube();
    CHECK(delotet_plc_point_markers(plc).data == NULL);
    OK(delotet_plc_set_point_markers(plc, markers, &error));
    CHECK(memcmp(delotet_plc_point_markers(plc).data, markers, sizeof markers) == 0);
    CHECK(delotet_plc_point_markers(NULL).count == 0);
    delotet_plc_free(plc);
    return 0;
}
