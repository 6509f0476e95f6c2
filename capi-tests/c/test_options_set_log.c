/* delotet_options_set_log: lines of text, to the pointer that was given. */
#include "test.h"

static void line(void *user_data, const char *message)
{
    int *wrong = (int *)user_data;
    *wrong |= message == NULL || strchr(message, '\n') != NULL;
}

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = twisted_prism();
    int wrong = 0;
    CHECK(delotet_options_set_log(options, line, &wrong) == DELOTET_STATUS_OK);
    delotet_mesh_free(mesh_with(plc, options));
    CHECK(!wrong);
    CHECK(delotet_options_set_log(options, NULL, NULL) == DELOTET_STATUS_OK);
    delotet_mesh_free(mesh_with(plc, options));
    CHECK(delotet_options_set_log(NULL, line, NULL) == INVALID);
    delotet_plc_free(plc);
    delotet_options_free(options);
    return 0;
}
