/* delotet_options_size_function: the function and the pointer that were set with it. */
#include "test.h"

static int32_t function(void *user_data, const double *point, double *size)
{
    (void)user_data;
    (void)point;
    (void)size;
    return 0;
}

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    int mine = 0;
    void *data = &mine;
    CHECK(delotet_options_size_function(options, &data) == NULL && data == NULL);
    OK(delotet_options_set_size_function(options, function, &mine, &error));
    CHECK(delotet_options_size_function(options, &data) == function && data == &mine);
    CHECK(delotet_options_size_function(options, NULL) == function);
    CHECK(delotet_options_size_function(NULL, &data) == NULL && data == NULL);
    OK(delotet_options_set_size_function(options, NULL, NULL, &error));
    CHECK(delotet_options_size_function(options, NULL) == NULL);
    delotet_options_free(options);
    return 0;
}
