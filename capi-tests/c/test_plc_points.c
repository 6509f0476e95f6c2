/* delotet_plc_points: the points as given, bit for bit. */
#include "test.h"

int main(void)
{
    double xyz[24];
    DelotetPlc *plc = cube();
    box_points(xyz, 0, 1);
    CHECK(delotet_plc_points(plc).count == 8);
    CHECK(memcmp(delotet_plc_points(plc).data, xyz, sizeof xyz) == 0);
    CHECK(delotet_plc_points(NULL).data == NULL && delotet_plc_points(NULL).count == 0);
    delotet_plc_free(plc);
    return 0;
}
