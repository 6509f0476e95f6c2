/* delotet_mesh_tet_faces: face i lies opposite corner i. */
#include "test.h"

int main(void)
{
    DelotetMesh *mesh = mesh_of(nested_boxes());
    DelotetFacesView faces;
    DelotetTetsView of;
    size_t tet, side, k;
    OK(delotet_mesh_faces(mesh, &faces, &error));
    OK(delotet_mesh_tet_faces(mesh, &of, &error));
    CHECK(of.count == delotet_mesh_tets(mesh).count);
    for (tet = 0; tet < of.count; tet++)
        for (side = 0; side < 4; side++) {
            DelotetFace face = *DELOTET_AT(DelotetFace, faces, of.data[4 * tet + side]);
            CHECK(face.tets[0] == tet || face.tets[1] == tet);
            for (k = 0; k < 3; k++)
                CHECK(face.corners[k] != delotet_mesh_tets(mesh).data[4 * tet + side]);
        }
    FAILS(INVALID, delotet_mesh_tet_faces(NULL, &of, &error));
    FAILS(INVALID, delotet_mesh_tet_faces(mesh, NULL, &error));
    delotet_mesh_free(mesh);
    return 0;
}
