/* delotet_cancel_token_new: not cancelled. */
#include "test.h"

int main(void)
{
    DelotetCancelToken *one = delotet_cancel_token_new(), *other = delotet_cancel_token_new();
    CHECK(one != NULL && other != NULL && one != other);
    CHECK(!delotet_cancel_token_is_cancelled(one));
    delotet_cancel_token_cancel(one);
    CHECK(!delotet_cancel_token_is_cancelled(other));
    delotet_cancel_token_free(one);
    delotet_cancel_token_free(other);
    return 0;
}
