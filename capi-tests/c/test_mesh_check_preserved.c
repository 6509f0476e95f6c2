/* delotet_mesh_check_preserved: the mode that keeps the surface passes, points on the surface are found. */
#include "preserved.h"

int main(void)
{
    test_preserved_check(delotet_mesh_check_preserved, DELOTET_PRESERVE_ALL);
    return 0;
}
