/* delotet_mesh_unmeshed_subfaces: pieces of facets that bound no tetrahedron are listed separately from the mesh's faces. */
#include "test.h"

int main(void)
{
    DelotetMesh *mesh = mesh_of(cube_with_fin());
    DelotetSubfacesView faces = delotet_mesh_subfaces(mesh), apart = delotet_mesh_unmeshed_subfaces(mesh);
    size_t i;
    CHECK(faces.count == 12);
    for (i = 0; i < faces.count; i++)
        CHECK(DELOTET_AT(DelotetSubface, faces, i)->tets[0] < delotet_mesh_tets(mesh).count && DELOTET_AT(DelotetSubface, faces, i)->marker != 9);
    CHECK(apart.count == 1 && DELOTET_AT(DelotetSubface, apart, 0)->facet == 12 && DELOTET_AT(DelotetSubface, apart, 0)->marker == 9);
    CHECK(DELOTET_AT(DelotetSubface, apart, 0)->tets[0] == DELOTET_INVALID_INDEX && DELOTET_AT(DelotetSubface, apart, 0)->tets[1] == DELOTET_INVALID_INDEX);
    CHECK(delotet_mesh_warning_count(mesh, DELOTET_WARNING_KIND_UNMESHED_FACET) == 1);
    CHECK(delotet_mesh_warning_count(mesh, DELOTET_WARNING_KIND_OPEN_EDGE) == 2);
    delotet_mesh_free(mesh);
    mesh = mesh_of(cube());
    CHECK(delotet_mesh_unmeshed_subfaces(mesh).count == 0);
    CHECK(delotet_mesh_unmeshed_subfaces(NULL).count == 0);
    delotet_mesh_free(mesh);
    return 0;
}
