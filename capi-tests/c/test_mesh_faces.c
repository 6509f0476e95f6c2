/* delotet_mesh_faces: every face once; Euler's formula; subfaces are marked. */
#include "test.h"

int main(void)
{
    DelotetMesh *mesh = mesh_of(nested_boxes());
    DelotetFacesView faces;
    DelotetEdgesView edges;
    DelotetFacesView again;
    size_t i, boundary = 0, marked = 0;
    OK(delotet_mesh_faces(mesh, &faces, &error));
    OK(delotet_mesh_edges(mesh, &edges, &error));
    CHECK(delotet_mesh_points(mesh).count + faces.count == 1 + edges.count + delotet_mesh_tets(mesh).count);
    for (i = 0; i < faces.count; i++) {
        const DelotetFace *face = DELOTET_AT(DelotetFace, faces, i);
        boundary += face->tets[1] == DELOTET_INVALID_INDEX;
        if (face->subface != DELOTET_INVALID_INDEX) {
            CHECK(face->marker == DELOTET_AT(DelotetSubface, delotet_mesh_subfaces(mesh), face->subface)->marker);
            marked++;
        } else
            CHECK(face->marker == 0);
    }
    CHECK(boundary == 12 && marked == delotet_mesh_subfaces(mesh).count);
    OK(delotet_mesh_faces(mesh, &again, &error));
    CHECK(again.first == faces.first);
    FAILS(INVALID, delotet_mesh_faces(NULL, &faces, &error));
    FAILS(INVALID, delotet_mesh_faces(mesh, NULL, &error));
    delotet_mesh_free(mesh);
    return 0;
}
