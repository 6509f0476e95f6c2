/* delotet_plc_segment_count: counts what was added. */
#include "test.h"

int main(void)
{
    DelotetPlc *plc = cube();
    CHECK(delotet_plc_segment_count(plc) == 0);
    OK(delotet_plc_add_segment(plc, 0, 1, 0, &error));
    CHECK(delotet_plc_segment_count(plc) == 1);
    CHECK(delotet_plc_segment_count(NULL) == 0);
    delotet_plc_free(plc);
    return 0;
}
