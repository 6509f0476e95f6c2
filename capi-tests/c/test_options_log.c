/* delotet_options_log: the callback and the pointer that were set with it. */
#include "test.h"

static void callback(void *user_data, const char *message)
{
    (void)user_data;
    (void)message;
}

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    int mine = 0;
    void *data = &mine;
    CHECK(delotet_options_log(options, &data) == NULL && data == NULL);
    OK(delotet_options_set_log(options, callback, &mine, &error));
    CHECK(delotet_options_log(options, &data) == callback && data == &mine);
    CHECK(delotet_options_log(options, NULL) == callback);
    CHECK(delotet_options_log(NULL, &data) == NULL && data == NULL);
    OK(delotet_options_set_log(options, NULL, NULL, &error));
    CHECK(delotet_options_log(options, NULL) == NULL);
    delotet_options_free(options);
    return 0;
}
