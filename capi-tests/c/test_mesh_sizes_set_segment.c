/* delotet_mesh_sizes_set_segment: the length wanted at the subsegments with a marker; infinite removes it. */
#include "test.h"

int main(void)
{
    DelotetPlc *plc = nested_boxes();
    DelotetMesh *mesh;
    DelotetMeshSizes *sizes = delotet_mesh_sizes_new();
    size_t none;
    OK(delotet_plc_add_segment(plc, 0, 8, 5, &error));
    mesh = mesh_of(plc);
    none = points_refined(mesh, sizes);
    OK(delotet_mesh_sizes_set_segment(sizes, 5, 0.3, &error));
    CHECK(points_refined(mesh, sizes) > none);
    FAILS(INVALID, delotet_mesh_sizes_set_segment(sizes, 5, 0, &error));
    FAILS(INVALID, delotet_mesh_sizes_set_segment(sizes, 5, NAN, &error));
    FAILS(INVALID, delotet_mesh_sizes_set_segment(NULL, 5, 1, &error));
    OK(delotet_mesh_sizes_set_segment(sizes, 5, INFINITY, &error));
    CHECK(points_refined(mesh, sizes) == none);
    delotet_mesh_sizes_free(sizes);
    delotet_mesh_free(mesh);
    return 0;
}
