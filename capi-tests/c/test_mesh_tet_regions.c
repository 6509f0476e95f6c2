/* delotet_mesh_tet_regions: one region per connected part, seeded or not. */
#include "test.h"

int main(void)
{
    DelotetMesh *mesh = mesh_of(nested_boxes());
    DelotetIndicesView of = delotet_mesh_tet_regions(mesh);
    size_t i, counts[2] = {0, 0};
    CHECK(of.count == delotet_mesh_tets(mesh).count && delotet_mesh_regions(mesh).count == 2);
    for (i = 0; i < of.count; i++) {
        CHECK(of.data[i] < 2);
        counts[of.data[i]]++;
    }
    CHECK(counts[0] > 0 && counts[1] > 0);
    CHECK(delotet_mesh_tet_regions(NULL).data == NULL);
    delotet_mesh_free(mesh);
    return 0;
}
