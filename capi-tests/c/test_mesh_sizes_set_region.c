/* delotet_mesh_sizes_set_region: the length wanted in the regions with an attribute; infinite removes it. */
#include "test.h"

int main(void)
{
    DelotetMesh *mesh = mesh_of(nested_boxes());
    DelotetMeshSizes *sizes = delotet_mesh_sizes_new();
    const size_t none = points_refined(mesh, sizes);
    OK(delotet_mesh_sizes_set_region(sizes, 1, 0.4, &error));
    CHECK(points_refined(mesh, sizes) > none);
    FAILS(INVALID, delotet_mesh_sizes_set_region(sizes, 1, 0, &error));
    FAILS(INVALID, delotet_mesh_sizes_set_region(sizes, 1, -1, &error));
    FAILS(INVALID, delotet_mesh_sizes_set_region(sizes, 1, NAN, &error));
    FAILS(INVALID, delotet_mesh_sizes_set_region(NULL, 1, 1, &error));
    FAILS(INVALID, delotet_mesh_sizes_set_region(sizes, NAN, 1, &error));
    OK(delotet_mesh_sizes_set_region(sizes, 1, INFINITY, &error));
    CHECK(points_refined(mesh, sizes) == none);
    delotet_mesh_sizes_free(sizes);
    delotet_mesh_free(mesh);
    return 0;
}
