/* delotet_plc_new: copies the points; refuses missing arrays and impossible counts. */
#include "test.h"

int main(void)
{
    double xyz[3] = {1, 2, 3};
    DelotetPlc *plc = NULL;
    OK(delotet_plc_new(xyz, 1, &plc, &error));
    xyz[0] = 9;
    CHECK(delotet_plc_points(plc).count == 1 && delotet_plc_points(plc).data[0] == 1);
    delotet_plc_free(plc);
    OK(delotet_plc_new(NULL, 0, &plc, &error));
    CHECK(delotet_plc_points(plc).count == 0 && delotet_plc_points(plc).data == NULL);
    delotet_plc_free(plc);
    FAILS(INVALID, delotet_plc_new(NULL, 1, &plc, &error));
    CHECK(plc == NULL);
    FAILS(INVALID, delotet_plc_new(xyz, SIZE_MAX, &plc, &error));
    FAILS(INVALID, delotet_plc_new(xyz, SIZE_MAX / 8, &plc, &error));
    FAILS(INVALID, delotet_plc_new(xyz, 1, NULL, &error));
    CHECK(delotet_plc_new(NULL, 1, &plc, NULL) == INVALID);
    return 0;
}
