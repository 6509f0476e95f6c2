/* delotet_mesh_sizes_new: no wish. */
#include "test.h"

int main(void)
{
    DelotetMesh *mesh = mesh_of(cube()), *same = NULL;
    DelotetMeshSizes *sizes = delotet_mesh_sizes_new();
    CHECK(sizes != NULL);
    OK(delotet_mesh_refine(mesh, sizes, NULL, &same, &error));
    CHECK(delotet_mesh_tets(same).count == delotet_mesh_tets(mesh).count);
    CHECK(delotet_mesh_points(same).count == 8);
    delotet_mesh_free(same);
    delotet_mesh_free(mesh);
    delotet_mesh_sizes_free(sizes);
    return 0;
}
