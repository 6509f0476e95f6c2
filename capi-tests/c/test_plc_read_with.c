/* delotet_plc_read_with: the limits of options count while a file is read. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    DelotetCancelToken *token = delotet_cancel_token_new();
    DelotetPlc *plc = NULL;
    FILE *file = fopen("test_plc_read_with.off", "w");
    int i;
    CHECK(file != NULL);
    fprintf(file, "OFF\n200000 1 0\n");
    for (i = 0; i < 200000; i++)
        fprintf(file, "%d %d %d\n", i, i % 100, i % 7);
    fprintf(file, "3 0 1 2\n");
    fclose(file);
    OK(delotet_options_set_cancel_token(options, token, &error));
    OK(delotet_plc_read_with("test_plc_read_with.off", options, &plc, &error));
    CHECK(delotet_plc_points(plc).count == 200000);
    delotet_plc_free(plc);
    OK(delotet_plc_read_with("test_plc_read_with.off", NULL, &plc, &error));
    delotet_plc_free(plc);
    delotet_cancel_token_cancel(token);
    FAILS(DELOTET_STATUS_CANCELLED, delotet_plc_read_with("test_plc_read_with.off", options, &plc, &error));
    CHECK(plc == NULL);
    delotet_cancel_token_reset(token);
    OK(delotet_options_set_time_limit(options, 1e-9, &error));
    FAILS(DELOTET_STATUS_TIME_LIMIT, delotet_plc_read_with("test_plc_read_with.off", options, &plc, &error));
    OK(delotet_options_set_time_limit(options, 0, &error));
#ifdef __linux__
    OK(delotet_options_set_memory_limit(options, 1000 * 1000, &error));
    FAILS(DELOTET_STATUS_MEMORY_LIMIT, delotet_plc_read_with("test_plc_read_with.off", options, &plc, &error));
    OK(delotet_options_set_memory_limit(options, 0, &error));
#endif
    remove("test_plc_read_with.off");
    FAILS(DELOTET_STATUS_FILE, delotet_plc_read_with("no/such/file.off", options, &plc, &error));
    FAILS(INVALID, delotet_plc_read_with(NULL, options, &plc, &error));
    FAILS(INVALID, delotet_plc_read_with("file.off", options, NULL, &error));
    delotet_cancel_token_free(token);
    delotet_options_free(options);
    return 0;
}
