/* delotet_mesh_sizes_set_tets: one length each, infinite where there is no wish; what is none is refused and changes nothing. */
#include "test.h"

int main(void)
{
    DelotetMesh *mesh = mesh_of(nested_boxes()), *fine = NULL;
    DelotetMeshSizes *sizes = delotet_mesh_sizes_new();
    const size_t none = points_refined(mesh, sizes), count = delotet_mesh_tets(mesh).count;
    double *lengths = (double *)malloc((count + 1) * sizeof *lengths);
    size_t i;
    CHECK(lengths != NULL);
    for (i = 0; i <= count; i++)
        lengths[i] = i == 0 ? 0.3 : INFINITY;
    OK(delotet_mesh_sizes_set_tets(sizes, lengths, count, &error));
    CHECK(points_refined(mesh, sizes) > none);
    lengths[1] = 0;
    FAILS(INVALID, delotet_mesh_sizes_set_tets(sizes, lengths, count, &error));
    lengths[1] = NAN;
    FAILS(INVALID, delotet_mesh_sizes_set_tets(sizes, lengths, count, &error));
    FAILS(INVALID, delotet_mesh_sizes_set_tets(sizes, NULL, count, &error));
    FAILS(INVALID, delotet_mesh_sizes_set_tets(sizes, lengths, SIZE_MAX / 4, &error));
    FAILS(INVALID, delotet_mesh_sizes_set_tets(NULL, lengths, count, &error));
    CHECK(points_refined(mesh, sizes) > none);
    lengths[1] = 1;
    OK(delotet_mesh_sizes_set_tets(sizes, lengths, count + 1, &error));
    FAILS(INVALID, delotet_mesh_refine(mesh, sizes, NULL, &fine, &error));
    OK(delotet_mesh_sizes_set_tets(sizes, NULL, 0, &error));
    CHECK(points_refined(mesh, sizes) == none);
    free(lengths);
    delotet_mesh_sizes_free(sizes);
    delotet_mesh_free(mesh);
    return 0;
}
