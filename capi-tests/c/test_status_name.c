/* delotet_status_name: known numbers have names, others do not. */
#include "test.h"

int main(void)
{
    CHECK(strcmp(delotet_status_name(DELOTET_STATUS_OK), "DELOTET_STATUS_OK") == 0);
    CHECK(strcmp(delotet_status_name(DELOTET_STATUS_SELF_INTERSECTION), "DELOTET_STATUS_SELF_INTERSECTION") == 0);
    CHECK(strcmp(delotet_status_name(90), "DELOTET_STATUS_INTERNAL") == 0);
    CHECK(strcmp(delotet_status_name(9), "unknown") == 0);
    CHECK(strcmp(delotet_status_name(UINT32_MAX), "unknown") == 0);
    return 0;
}
