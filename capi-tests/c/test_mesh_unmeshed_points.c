/* delotet_mesh_unmeshed_points: the points that no tetrahedron has, ascending. */
#include "test.h"

int main(void)
{
    DelotetMesh *mesh = mesh_of(cube_with_fin());
    DelotetIndicesView apart = delotet_mesh_unmeshed_points(mesh);
    CHECK(apart.count == 3);
    CHECK(apart.data[0] == 8 && apart.data[1] == 9 && apart.data[2] == 10);
    CHECK(delotet_mesh_warning_count(mesh, DELOTET_WARNING_KIND_UNMESHED_POINT) == 3);
    delotet_mesh_free(mesh);
    mesh = mesh_of(cube());
    CHECK(delotet_mesh_unmeshed_points(mesh).count == 0 && delotet_mesh_unmeshed_points(mesh).data == NULL);
    delotet_mesh_free(mesh);
    CHECK(delotet_mesh_unmeshed_points(NULL).count == 0);
    return 0;
}
