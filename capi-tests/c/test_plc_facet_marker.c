/* delotet_plc_facet_marker: 0 where there is no facet. */
#include "test.h"

int main(void)
{
    DelotetPlc *plc = cube();
    CHECK(delotet_plc_facet_marker(plc, 0) == 1 && delotet_plc_facet_marker(plc, 11) == 6);
    CHECK(delotet_plc_facet_marker(plc, 12) == 0);
    CHECK(delotet_plc_facet_marker(plc, DELOTET_INVALID_INDEX) == 0);
    CHECK(delotet_plc_facet_marker(NULL, 0) == 0);
    delotet_plc_free(plc);
    return 0;
}
