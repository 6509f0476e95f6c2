/* delotet_plc_add_segments: with and without markers; nothing is added on failure. */
#include "test.h"

int main(void)
{
    static const uint32_t ends[4] = {0, 1, 1, 3}, wrong[4] = {0, 1, 1, 8};
    static const int32_t markers[2] = {4, 5};
    DelotetPlc *plc = cube();
    DelotetError *error = NULL;
    const DelotetDefect *defect;
    OK(delotet_plc_add_segments(plc, ends, NULL, 2, &error));
    OK(delotet_plc_add_segments(plc, ends, markers, 2, &error));
    OK(delotet_plc_add_segments(plc, NULL, NULL, 0, &error));
    CHECK(delotet_plc_segment_count(plc) == 4);
    CHECK(delotet_plc_add_segments(plc, wrong, NULL, 2, &error) == DELOTET_STATUS_INDEX_OUT_OF_RANGE);
    CHECK(delotet_error_defects(error).count == 1);
    defect = DELOTET_AT(DelotetDefect, delotet_error_defects(error), 0);
    CHECK(defect->kind == DELOTET_DEFECT_KIND_INDEX_OUT_OF_RANGE);
    CHECK(defect->first_element == DELOTET_ELEMENT_SEGMENT);
    CHECK(defect->first == 5);
    CHECK(defect->second == 8);
    delotet_error_free(error);
    FAILS(INVALID, delotet_plc_add_segments(plc, NULL, NULL, 1, &error));
    FAILS(INVALID, delotet_plc_add_segments(plc, ends, NULL, SIZE_MAX, &error));
    FAILS(INVALID, delotet_plc_add_segments(NULL, ends, NULL, 1, &error));
    CHECK(delotet_plc_segment_count(plc) == 4);
    delotet_plc_free(plc);
    return 0;
}
