/* delotet_options_progress: the callback and the pointer that were set with it. */
#include "test.h"

static int32_t callback(void *user_data, DelotetPhase phase, double fraction)
{
    (void)user_data;
    (void)phase;
    (void)fraction;
    return 0;
}

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    int mine = 0;
    void *data = &mine;
    CHECK(delotet_options_progress(options, &data) == NULL && data == NULL);
    OK(delotet_options_set_progress(options, callback, &mine, &error));
    CHECK(delotet_options_progress(options, &data) == callback && data == &mine);
    CHECK(delotet_options_progress(options, NULL) == callback);
    CHECK(delotet_options_progress(NULL, &data) == NULL && data == NULL);
    OK(delotet_options_set_progress(options, NULL, NULL, &error));
    CHECK(delotet_options_progress(options, NULL) == NULL);
    delotet_options_free(options);
    return 0;
}
