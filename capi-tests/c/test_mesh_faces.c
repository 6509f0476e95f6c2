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
        boundary += faces.data[i].tets[1] == DELOTET_INVALID_INDEX;
        if (faces.data[i].subface != DELOTET_INVALID_INDEX) {
            CHECK(faces.data[i].marker == delotet_mesh_subfaces(mesh).data[faces.data[i].subface].marker);
            marked++;
        } else
            CHECK(faces.data[i].marker == 0);
    }
    CHECK(boundary == 12 && marked == delotet_mesh_subfaces(mesh).count);
    OK(delotet_mesh_faces(mesh, &again, &error));
    CHECK(again.data == faces.data);
    FAILS(INVALID, delotet_mesh_faces(NULL, &faces, &error));
    FAILS(INVALID, delotet_mesh_faces(mesh, NULL, &error));
    delotet_mesh_free(mesh);
    return 0;
}
