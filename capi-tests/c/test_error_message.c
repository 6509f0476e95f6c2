/* delotet_error_message: names the argument at fault. */
#include "test.h"

int main(void)
{
    DelotetError *error = NULL;
    DelotetPlc *plc;
    CHECK(delotet_plc_new(NULL, 5, &plc, &error) != DELOTET_STATUS_OK);
    CHECK(strcmp(delotet_error_message(error), "xyz is null") == 0);
    CHECK(strcmp(delotet_error_message(NULL), "") == 0);
    delotet_error_free(error);
    return 0;
}
