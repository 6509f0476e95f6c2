/* delotet_mesh_sizes_set_facet_area: the area wanted of the subfaces with a marker; infinite removes it. */
#include "test.h"

int main(void)
{
    DelotetMesh *mesh = mesh_of(nested_boxes());
    DelotetMeshSizes *sizes = delotet_mesh_sizes_new();
    const size_t none = points_refined(mesh, sizes);
    OK(delotet_mesh_sizes_set_facet_area(sizes, 7, 0.07, &error));
    CHECK(points_refined(mesh, sizes) > none);
    FAILS(INVALID, delotet_mesh_sizes_set_facet_area(sizes, 7, 0, &error));
    FAILS(INVALID, delotet_mesh_sizes_set_facet_area(sizes, 7, -1, &error));
    FAILS(INVALID, delotet_mesh_sizes_set_facet_area(sizes, 7, NAN, &error));
    FAILS(INVALID, delotet_mesh_sizes_set_facet_area(NULL, 7, 1, &error));
    OK(delotet_mesh_sizes_set_facet_area(sizes, 7, INFINITY, &error));
    CHECK(points_refined(mesh, sizes) == none);
    delotet_mesh_sizes_free(sizes);
    delotet_mesh_free(mesh);
    return 0;
}
