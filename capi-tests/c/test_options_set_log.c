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
    OK(delotet_options_set_log(options, line, &wrong, &error));
    delotet_mesh_free(mesh_with(plc, options));
    CHECK(!wrong);
    OK(delotet_options_set_log(options, NULL, NULL, &error));
    delotet_mesh_free(mesh_with(plc, options));
    FAILS(INVALID, delotet_options_set_log(NULL, line, NULL, &error));
    delotet_plc_free(plc);
    delotet_options_free(options);
    return 0;
}
