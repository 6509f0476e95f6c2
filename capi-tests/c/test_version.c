/* delotet_version: the library is the one that the header describes. */
#include "test.h"

int main(void)
{
    CHECK(delotet_version() == DELOTET_VERSION);
    CHECK(DELOTET_VERSION == 1000000 * DELOTET_VERSION_MAJOR + 1000 * DELOTET_VERSION_MINOR + DELOTET_VERSION_PATCH);
    return 0;
}
