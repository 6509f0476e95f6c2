/* delotet_mesh_sizes_set_segment: the length wanted at the subsegments with a marker; infinite removes it. */
#include "test.h"

/* Points of a box, with a wall in two regions, after refining with these sizes. */
static size_t refined(const DelotetMesh *mesh, const DelotetMeshSizes *sizes)
{
    DelotetMesh *fine = NULL;
    size_t count;
    OK(delotet_mesh_refine(mesh, sizes, NULL, &fine, &error));
    count = delotet_mesh_points(fine).count;
    CHECK(near(volume(fine), volume(mesh)));
    delotet_mesh_free(fine);
    return count;
}

int main(void)
{
    DelotetPlc *plc = nested_boxes();
    DelotetMesh *mesh;
    DelotetMeshSizes *sizes = delotet_mesh_sizes_new();
    size_t none;
    OK(delotet_plc_add_segment(plc, 0, 8, 5, &error));
    mesh = mesh_of(plc);
    none = refined(mesh, sizes);
    OK(delotet_mesh_sizes_set_segment(sizes, 5, 0.3, &error));
    CHECK(refined(mesh, sizes) > none);
    FAILS(INVALID, delotet_mesh_sizes_set_segment(sizes, 5, 0, &error));
    FAILS(INVALID, delotet_mesh_sizes_set_segment(sizes, 5, NAN, &error));
    FAILS(INVALID, delotet_mesh_sizes_set_segment(NULL, 5, 1, &error));
    OK(delotet_mesh_sizes_set_segment(sizes, 5, INFINITY, &error));
    CHECK(refined(mesh, sizes) == none);
    delotet_mesh_sizes_free(sizes);
    delotet_mesh_free(mesh);
    return 0;
}
