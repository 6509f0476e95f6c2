/* delotet_plc_point_attributes: empty unless set. */
#include "test.h"

int main(void)
{
    double attributes[24];
    DelotetPlc *plc = cube();
    CHECK(delotet_plc_point_attributes(plc).count == 0 && delotet_plc_point_attributes(plc).width == 0);
    box_points(attributes, -1, 1);
    OK(delotet_plc_set_point_attributes(plc, attributes, 3, &error));
    CHECK(delotet_plc_point_attributes(plc).count == 8 && delotet_plc_point_attributes(plc).width == 3);
    CHECK(memcmp(delotet_plc_point_attributes(plc).data, attributes, sizeof attributes) == 0);
    CHECK(delotet_plc_point_attributes(NULL).data == NULL);
    delotet_plc_free(plc);
    return 0;
}
