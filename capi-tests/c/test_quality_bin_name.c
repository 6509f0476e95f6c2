/* delotet_quality_bin_name: bins have names, other numbers do not. */
#include "test.h"

int main(void)
{
    CHECK(strcmp(delotet_quality_bin_name(DELOTET_QUALITY_MIN_DIHEDRAL, 0), "below 1") == 0);
    CHECK(strcmp(delotet_quality_bin_name(DELOTET_QUALITY_MIN_DIHEDRAL, 3), "10 to 15") == 0);
    CHECK(strcmp(delotet_quality_bin_name(DELOTET_QUALITY_ETA, DELOTET_QUALITY_BINS - 1), "from 0.9") == 0);
    CHECK(strcmp(delotet_quality_bin_name(DELOTET_QUALITY_ETA, DELOTET_QUALITY_BINS), "unknown") == 0);
    CHECK(strcmp(delotet_quality_bin_name(99, 0), "unknown") == 0);
    return 0;
}
