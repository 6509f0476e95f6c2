/* delotet_plc_facet_rule: rings, unless the facet was added with hole seeds. */
#include "test.h"

int main(void)
{
    static const uint32_t corners[7] = {0, 2, 3, 1, 4, 5, 6};
    static const size_t ends[2] = {4, 7};
    DelotetPlc *plc = cube();
    OK(delotet_plc_add_facet(plc, corners, ends, 2, 9, &error));
    OK(delotet_plc_add_facet_with_hole_seeds(plc, corners, ends, 2, NULL, 0, 9, &error));
    CHECK(delotet_plc_facet_rule(plc, 0) == DELOTET_FACET_RULE_RINGS);
    CHECK(delotet_plc_facet_rule(plc, 12) == DELOTET_FACET_RULE_RINGS);
    CHECK(delotet_plc_facet_rule(plc, 13) == DELOTET_FACET_RULE_SEEDS);
    CHECK(delotet_plc_facet_rule(plc, 14) == DELOTET_FACET_RULE_RINGS);
    CHECK(delotet_plc_facet_rule(NULL, 0) == DELOTET_FACET_RULE_RINGS);
    delotet_plc_free(plc);
    return 0;
}
