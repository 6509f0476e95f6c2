/* delotet_quality_measure_name: known numbers have names, others do not. */
#include "test.h"

int main(void)
{
    CHECK(strcmp(delotet_quality_measure_name(DELOTET_QUALITY_MIN_DIHEDRAL), "DELOTET_QUALITY_MIN_DIHEDRAL") == 0);
    CHECK(strcmp(delotet_quality_measure_name(DELOTET_QUALITY_ETA), "DELOTET_QUALITY_ETA") == 0);
    CHECK(strcmp(delotet_quality_measure_name(99), "unknown") == 0);
    return 0;
}
