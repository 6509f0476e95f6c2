/* delotet_mesh_regions: unseeded regions have attributes of their own. */
#include "test.h"

int main(void)
{
    static const double seed[3] = {1.5, 1.5, 1.5};
    DelotetPlc *plc = nested_boxes();
    DelotetMesh *mesh;
    DelotetRegionsView regions;
    const DelotetRegion *seeded, *other;
    OK(delotet_plc_add_region(plc, seed, 1, -1, &error));
    mesh = mesh_of(plc);
    regions = delotet_mesh_regions(mesh);
    CHECK(regions.count == 2);
    seeded = DELOTET_AT(DelotetRegion, regions, 0);
    other = DELOTET_AT(DelotetRegion, regions, 1);
    if (seeded->seed != 0) {
        other = seeded;
        seeded = DELOTET_AT(DelotetRegion, regions, 1);
    }
    CHECK(seeded->seed == 0 && seeded->attribute == 1);
    CHECK(seeded->max_volume == 0);
    CHECK(other->seed == DELOTET_INVALID_INDEX && other->attribute != 1);
    CHECK(delotet_mesh_regions(NULL).first == NULL);
    delotet_mesh_free(mesh);
    return 0;
}
