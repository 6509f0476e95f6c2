/* delotet_write_options_log: the callback and its pointer, NULL without one. */
#include "test.h"

static void line(void *user_data, const char *message)
{
    (void)user_data;
    (void)message;
}

int main(void)
{
    DelotetWriteOptions *options = delotet_write_options_new();
    int data = 0;
    void *found = &data;
    CHECK(delotet_write_options_log(options, &found) == NULL && found == NULL);
    OK(delotet_write_options_set_log(options, line, &data, &error));
    CHECK(delotet_write_options_log(options, &found) == line && found == &data);
    CHECK(delotet_write_options_log(options, NULL) == line);
    CHECK(delotet_write_options_log(NULL, &found) == NULL && found == NULL);
    delotet_write_options_free(options);
    return 0;
}
