/* delotet_plc_segments: ends and markers as they were given. */
#include "test.h"

int main(void)
{
    static const uint32_t ends[4] = {0, 1, 7, 3};
    static const int32_t markers[2] = {4, -5};
    DelotetPlc *plc = cube();
    DelotetSegmentsView segments;
    CHECK(delotet_plc_segments(plc).count == 0 && delotet_plc_segments(plc).first == NULL);
    OK(delotet_plc_add_segments(plc, ends, markers, 2, &error));
    segments = delotet_plc_segments(plc);
    CHECK(segments.count == 2 && segments.stride >= sizeof(DelotetSegment));
    CHECK(DELOTET_AT(DelotetSegment, segments, 1)->ends[0] == 7 && DELOTET_AT(DelotetSegment, segments, 1)->ends[1] == 3);
    CHECK(DELOTET_AT(DelotetSegment, segments, 0)->marker == 4 && DELOTET_AT(DelotetSegment, segments, 1)->marker == -5);
    CHECK(delotet_plc_segments(NULL).count == 0);
    delotet_plc_free(plc);
    return 0;
}
