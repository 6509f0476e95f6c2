/* delotet_mesh_subfaces: facet, marker, corners and both tetrahedra. */
#include "test.h"

int main(void)
{
    DelotetMesh *mesh = mesh_of(nested_boxes());
    DelotetSubfacesView subfaces = delotet_mesh_subfaces(mesh);
    DelotetTetsView tets = delotet_mesh_tets(mesh);
    DelotetIndicesView regions = delotet_mesh_tet_regions(mesh);
    const double *xyz = delotet_mesh_points(mesh).data;
    size_t i, k, outer = 0, inner = 0;
    for (i = 0; i < subfaces.count; i++) {
        DelotetSubface face = *DELOTET_AT(DelotetSubface, subfaces, i);
        CHECK(face.facet < 24 && face.marker == (face.facet < 12 ? 7 : 8));
        outer += face.facet < 12;
        inner += face.facet >= 12;
        CHECK(face.tets[0] != DELOTET_INVALID_INDEX);
        /* From the lower region to the higher. */
        if (face.tets[1] != DELOTET_INVALID_INDEX)
            CHECK(regions.data[face.tets[0]] == 0 && regions.data[face.tets[1]] == 1);
    CHECK((face.tets[0] == DELOTET_INVALID_INDEX || face.tets[1] == DELOTET_INVALID_INDEX) == (face.facet < 12));
        for (k = 0; k < 2; k++)
            if (face.tets[k] != DELOTET_INVALID_INDEX) {
                const uint32_t *tet = tets.data + 4 * face.tets[k];
                uint32_t seen[4] = {face.corners[0], face.corners[1], face.corners[2], DELOTET_INVALID_INDEX};
                int corner;
                for (corner = 0; corner < 4; corner++)
                    if (tet[corner] != seen[0] && tet[corner] != seen[1] && tet[corner] != seen[2]) {
                        CHECK(seen[3] == DELOTET_INVALID_INDEX);
                        seen[3] = tet[corner];
                    }
                CHECK(seen[3] != DELOTET_INVALID_INDEX);
                /* The normal points from the first tetrahedron to the second. */
                CHECK((volume_of(xyz, seen) > 0) == (k == 1));
            }
    }
    CHECK(outer >= 12 && inner >= 12);
    CHECK(delotet_mesh_subfaces(NULL).first == NULL);
    delotet_mesh_free(mesh);
    return 0;
}
