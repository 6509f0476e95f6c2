/* delotet_plc_facet_size: that of facets with a marker; infinite without a wish; copies have it. */
#include "test.h"

int main(void)
{
    DelotetPlc *plc = nested_boxes(), *copy = NULL;
    CHECK(isinf(delotet_plc_facet_size(plc, 8)) && isinf(delotet_plc_facet_size(NULL, 8)));
    OK(delotet_plc_set_facet_size(plc, 8, 0.5, &error));
    OK(delotet_plc_set_facet_size(plc, -3, 2, &error));
    OK(delotet_plc_clone(plc, &copy, &error));
    delotet_plc_free(plc);
    CHECK(delotet_plc_facet_size(copy, 8) == 0.5 && delotet_plc_facet_size(copy, -3) == 2);
    CHECK(isinf(delotet_plc_facet_size(copy, 7)) && delotet_plc_facet_size(copy, 7) > 0);
    delotet_plc_free(copy);
    return 0;
}
