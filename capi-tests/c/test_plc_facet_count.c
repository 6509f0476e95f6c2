/* delotet_plc_facet_count: counts what was added. */
#include "test.h"

int main(void)
{
    DelotetPlc *plc = cube();
    CHECK(delotet_plc_facet_count(plc) == 12);
    CHECK(delotet_plc_facet_count(NULL) == 0);
    delotet_plc_free(plc);
    return 0;
}
