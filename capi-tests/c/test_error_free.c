/* delotet_error_free: NULL is ignored. */
#include "test.h"

int main(void)
{
    DelotetError *error = NULL;
    delotet_error_free(NULL);
    CHECK(delotet_plc_add_hole(NULL, NULL, &error) == DELOTET_STATUS_INVALID_ARGUMENT);
    CHECK(error != NULL);
    delotet_error_free(error);
    return 0;
}
