/* delotet_options_free: NULL is ignored. */
#include "test.h"

int main(void)
{
    delotet_options_free(NULL);
    delotet_options_free(delotet_options_new());
    return 0;
}
