/* delotet_cancel_token_is_cancelled: what was done last. */
#include "test.h"

int main(void)
{
    DelotetCancelToken *token = delotet_cancel_token_new();
    CHECK(!delotet_cancel_token_is_cancelled(token) && !delotet_cancel_token_is_cancelled(NULL));
    delotet_cancel_token_cancel(token);
    CHECK(delotet_cancel_token_is_cancelled(token));
    delotet_cancel_token_reset(token);
    CHECK(!delotet_cancel_token_is_cancelled(token));
    delotet_cancel_token_free(token);
    return 0;
}
