/* delotet_mesh_free: NULL is ignored. */
#include "test.h"

int main(void)
{
    delotet_mesh_free(NULL);
    delotet_mesh_free(mesh_of(cube()));
    return 0;
}
