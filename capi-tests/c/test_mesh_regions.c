/* delotet_mesh_regions: unseeded regions have attributes of their own. */
#include "test.h"

int main(void)
{
    static const double seed[3] = {1.5, 1.5, 1.5};
    DelotetPlc *plc = nested_boxes();
    DelotetMesh *mesh;
    DelotetRegionsView regions;
    int seeded;
    OK(delotet_plc_add_region(plc, seed, 1, -1, &error));
    mesh = mesh_of(plc);
    regions = delotet_mesh_regions(mesh);
    CHECK(regions.count == 2);
    seeded = regions.data[0].seed == 0 ? 0 : 1;
    CHECK(regions.data[seeded].seed == 0 && regions.data[seeded].attribute == 1);
    CHECK(regions.data[seeded].max_volume == 0);
    CHECK(regions.data[1 - seeded].seed == DELOTET_INVALID_INDEX && regions.data[1 - seeded].attribute != 1);
    CHECK(delotet_mesh_regions(NULL).data == NULL);
    delotet_mesh_free(mesh);
    return 0;
}
