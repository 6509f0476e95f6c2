/* delotet_error_defects: kind, elements and point of every defect. */
#include "test.h"

int main(void)
{
    DelotetPlc *plc = pierced();
    DelotetError *error = NULL;
    DelotetDefectsView defects;
    size_t i;
    int seen = 0;
    CHECK(delotet_plc_check(plc, NULL, &error) == DELOTET_STATUS_SELF_INTERSECTION);
    defects = delotet_error_defects(error);
    CHECK(defects.count > 0 && defects.first != NULL);
    for (i = 0; i < defects.count; i++) {
        const DelotetDefect *defect = DELOTET_AT(DelotetDefect, defects, i);
        int pair = (defect->first == 0 && defect->second == 4) || (defect->first == 4 && defect->second == 0);
        CHECK(defect->second != DELOTET_INVALID_INDEX || defect->second_element == DELOTET_ELEMENT_NONE);
        if (pair && defect->first_element == DELOTET_ELEMENT_FACET && defect->second_element == DELOTET_ELEMENT_FACET) {
            seen = 1;
            CHECK(defect->has_point == 1);
            CHECK(fabs(defect->point[2]) < 1e-12); /* The triangle pierces the side z = 0. */
        }
    }
    CHECK(seen);
    delotet_error_free(error);
    delotet_plc_free(plc);
    defects = delotet_error_defects(NULL);
    CHECK(defects.first == NULL && defects.count == 0);
    return 0;
}
