/* delotet_mesh_unmeshed_subsegments: pieces of edges that no tetrahedron has are listed separately from the mesh's edges. */
#include "test.h"

int main(void)
{
    DelotetMesh *mesh = mesh_of(cube_with_fin());
    DelotetSubsegmentsView edges = delotet_mesh_subsegments(mesh), apart = delotet_mesh_unmeshed_subsegments(mesh);
    size_t i, loose = 0;
    CHECK(edges.count == 12);
    CHECK(apart.count == 3);
    for (i = 0; i < apart.count; i++)
        loose += DELOTET_AT(DelotetSubsegment, apart, i)->segment == 0 && DELOTET_AT(DelotetSubsegment, apart, i)->marker == 4;
    CHECK(loose == 1);
    CHECK(delotet_mesh_warning_count(mesh, DELOTET_WARNING_KIND_UNMESHED_SEGMENT) == 1);
    delotet_mesh_free(mesh);
    CHECK(delotet_mesh_unmeshed_subsegments(NULL).count == 0);
    return 0;
}
