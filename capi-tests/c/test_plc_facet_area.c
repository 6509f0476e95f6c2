/* delotet_plc_facet_area: that of facets with a marker; infinite without a wish; copies have it. */
#include "test.h"

int main(void)
{
    DelotetPlc *plc = nested_boxes(), *copy = NULL;
    CHECK(isinf(delotet_plc_facet_area(plc, 8)) && isinf(delotet_plc_facet_area(NULL, 8)));
    OK(delotet_plc_set_facet_area(plc, 8, 0.5, &error));
    OK(delotet_plc_set_facet_area(plc, -3, 2, &error));
    OK(delotet_plc_clone(plc, &copy, &error));
    delotet_plc_free(plc);
    CHECK(delotet_plc_facet_area(copy, 8) == 0.5 && delotet_plc_facet_area(copy, -3) == 2);
    CHECK(isinf(delotet_plc_facet_area(copy, 7)) && delotet_plc_facet_area(copy, 7) > 0);
    delotet_plc_free(copy);
    return 0;
}
