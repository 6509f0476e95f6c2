/* delotet_phase_name: known numbers have names, others do not. */
#include "test.h"

int main(void)
{
    CHECK(strcmp(delotet_phase_name(DELOTET_PHASE_READ), "DELOTET_PHASE_READ") == 0);
    CHECK(strcmp(delotet_phase_name(DELOTET_PHASE_WRITE), "DELOTET_PHASE_WRITE") == 0);
    CHECK(strcmp(delotet_phase_name(DELOTET_PHASE_PRESERVE), "DELOTET_PHASE_PRESERVE") == 0);
    CHECK(strcmp(delotet_phase_name(DELOTET_PHASE_REFINE), "DELOTET_PHASE_REFINE") == 0);
    CHECK(strcmp(delotet_phase_name(DELOTET_PHASE_OPTIMIZE), "DELOTET_PHASE_OPTIMIZE") == 0);
    CHECK(strcmp(delotet_phase_name(99), "unknown") == 0);
    return 0;
}
