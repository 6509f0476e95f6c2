/* delotet_skinny_cause_name: known numbers have names, others do not. */
#include "test.h"

int main(void)
{
    CHECK(strcmp(delotet_skinny_cause_name(DELOTET_SKINNY_WEDGE), "DELOTET_SKINNY_WEDGE") == 0);
    CHECK(strcmp(delotet_skinny_cause_name(DELOTET_SKINNY_OTHER), "DELOTET_SKINNY_OTHER") == 0);
    CHECK(strcmp(delotet_skinny_cause_name(99), "unknown") == 0);
    return 0;
}
