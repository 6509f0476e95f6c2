/* delotet_version_string: the text says what the numbers say. */
#include "test.h"

int main(void)
{
    char text[64];
    snprintf(text, sizeof text, "%d.%d.%d", DELOTET_VERSION_MAJOR, DELOTET_VERSION_MINOR, DELOTET_VERSION_PATCH);
    CHECK(strcmp(text, delotet_version_string()) == 0);
    CHECK(strcmp(text, DELOTET_VERSION_STRING) == 0);
    return 0;
}
