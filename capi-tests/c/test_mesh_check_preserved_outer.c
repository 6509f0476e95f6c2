/* delotet_mesh_check_preserved_outer: the mode that keeps the surface passes, points on the outer boundary are found. */
#include "preserved.h"

int main(void)
{
    test_preserved_check(delotet_mesh_check_preserved_outer, DELOTET_PRESERVE_OUTER);
    return 0;
}
