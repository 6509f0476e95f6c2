/* delotet_warning_kind_name: known numbers have names, others do not. */
#include "test.h"

int main(void)
{
    uint32_t kind;
    CHECK(strcmp(delotet_warning_kind_name(DELOTET_WARNING_KIND_OPEN_EDGE), "DELOTET_WARNING_KIND_OPEN_EDGE") == 0);
    CHECK(strcmp(delotet_warning_kind_name(DELOTET_WARNING_KIND_LOST_VALUE), "DELOTET_WARNING_KIND_LOST_VALUE") == 0);
    CHECK(strcmp(delotet_warning_kind_name(0), "unknown") == 0);
    CHECK(strcmp(delotet_warning_kind_name(DELOTET_WARNING_KIND_LOST_VALUE + 1), "unknown") == 0);
    for (kind = 1; kind <= DELOTET_WARNING_KIND_LOST_VALUE; kind++)
        CHECK(strncmp(delotet_warning_kind_name(kind), "DELOTET_WARNING_KIND_", 21) == 0);
    return 0;
}
