/* delotet_element_name: known numbers have names, others do not. */
#include "test.h"

int main(void)
{
    CHECK(strcmp(delotet_element_name(DELOTET_ELEMENT_NONE), "DELOTET_ELEMENT_NONE") == 0);
    CHECK(strcmp(delotet_element_name(DELOTET_ELEMENT_FACET), "DELOTET_ELEMENT_FACET") == 0);
    CHECK(strcmp(delotet_element_name(DELOTET_ELEMENT_TET), "DELOTET_ELEMENT_TET") == 0);
    CHECK(strcmp(delotet_element_name(77), "unknown") == 0);
    return 0;
}
