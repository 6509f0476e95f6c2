/* delotet_error_status: the status of the call again. */
#include "test.h"

int main(void)
{
    DelotetError *error = NULL;
    DelotetPlc *plc = (DelotetPlc *)1;
    CHECK(delotet_plc_new(NULL, 5, &plc, &error) == DELOTET_STATUS_INVALID_ARGUMENT);
    CHECK(plc == NULL);
    CHECK(delotet_error_status(error) == DELOTET_STATUS_INVALID_ARGUMENT);
    CHECK(delotet_error_status(NULL) == DELOTET_STATUS_OK);
    delotet_error_free(error);
    return 0;
}
