/* delotet_defect_kind_name: known numbers have names, others do not. */
#include "test.h"

int main(void)
{
    uint32_t kind;
    CHECK(strcmp(delotet_defect_kind_name(DELOTET_DEFECT_KIND_NON_FINITE), "DELOTET_DEFECT_KIND_NON_FINITE") == 0);
    CHECK(strcmp(delotet_defect_kind_name(DELOTET_DEFECT_KIND_HULL_OFF_FACETS), "DELOTET_DEFECT_KIND_HULL_OFF_FACETS") == 0);
    CHECK(strcmp(delotet_defect_kind_name(0), "unknown") == 0);
    for (kind = 1; kind <= DELOTET_DEFECT_KIND_HULL_OFF_FACETS; kind++)
        CHECK(strncmp(delotet_defect_kind_name(kind), "DELOTET_DEFECT_KIND_", 20) == 0);
    return 0;
}
