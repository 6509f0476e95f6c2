/* delotet_mesh_neighbors: mutual, across a common face. */
#include "test.h"

int main(void)
{
    DelotetMesh *mesh = mesh_of(nested_boxes());
    DelotetTetsView tets = delotet_mesh_tets(mesh), neighbors = delotet_mesh_neighbors(mesh);
    size_t tet, side, back, boundary = 0;
    CHECK(neighbors.count == tets.count);
    for (tet = 0; tet < tets.count; tet++)
        for (side = 0; side < 4; side++) {
            uint32_t other = neighbors.data[4 * tet + side];
            int found = 0;
            if (other == DELOTET_INVALID_INDEX) {
                boundary++;
                continue;
            }
            CHECK(other < tets.count);
            for (back = 0; back < 4; back++)
                if (neighbors.data[4 * other + back] == tet)
                    found = 1;
            CHECK(found);
        }
    CHECK(boundary == 12);
    CHECK(delotet_mesh_neighbors(NULL).data == NULL);
    delotet_mesh_free(mesh);
    return 0;
}
