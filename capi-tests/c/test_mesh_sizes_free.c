/* delotet_mesh_sizes_free: NULL is ignored; sizes with content are freed. */
#include "test.h"

int main(void)
{
    static const double lengths[3] = {1, 2, 3};
    DelotetMeshSizes *sizes = delotet_mesh_sizes_new();
    OK(delotet_mesh_sizes_set_points(sizes, lengths, 3, &error));
    OK(delotet_mesh_sizes_set_facet(sizes, 1, 2, &error));
    delotet_mesh_sizes_free(sizes);
    delotet_mesh_sizes_free(NULL);
    return 0;
}
