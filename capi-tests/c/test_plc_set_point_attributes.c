/* delotet_plc_set_point_attributes: copied, replaced, removed. */
#include "test.h"

int main(void)
{
    double two[16], one[8] = {1, 2, 3, 4, 5, 6, 7, 8};
    DelotetPlc *plc = cube();
    int i;
    for (i = 0; i < 16; i++)
        two[i] = i;
    OK(delotet_plc_set_point_attributes(plc, two, 2, &error));
    CHECK(delotet_plc_point_attributes(plc).width == 2 && delotet_plc_point_attributes(plc).data[15] == 15);
    OK(delotet_plc_set_point_attributes(plc, one, 1, &error));
    CHECK(delotet_plc_point_attributes(plc).width == 1 && delotet_plc_point_attributes(plc).count == 8);
    OK(delotet_plc_set_point_attributes(plc, NULL, 0, &error));
    CHECK(delotet_plc_point_attributes(plc).data == NULL);
    FAILS(INVALID, delotet_plc_set_point_attributes(plc, NULL, 1, &error));
    FAILS(INVALID, delotet_plc_set_point_attributes(plc, one, SIZE_MAX / 2, &error));
    FAILS(INVALID, delotet_plc_set_point_attributes(NULL, one, 1, &error));
    delotet_plc_free(plc);
    return 0;
}
