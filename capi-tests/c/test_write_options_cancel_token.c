/* delotet_write_options_cancel_token: what was set, NULL without one. */
#include "test.h"

int main(void)
{
    DelotetCancelToken *token = delotet_cancel_token_new();
    DelotetWriteOptions *options = delotet_write_options_new();
    CHECK(delotet_write_options_cancel_token(options) == NULL && delotet_write_options_cancel_token(NULL) == NULL);
    OK(delotet_write_options_set_cancel_token(options, token, &error));
    CHECK(delotet_write_options_cancel_token(options) == token);
    delotet_cancel_token_free(token);
    delotet_cancel_token_cancel(delotet_write_options_cancel_token(options));
    CHECK(delotet_cancel_token_is_cancelled(delotet_write_options_cancel_token(options)));
    OK(delotet_write_options_set_cancel_token(options, NULL, &error));
    CHECK(delotet_write_options_cancel_token(options) == NULL);
    delotet_write_options_free(options);
    return 0;
}
