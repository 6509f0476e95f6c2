/* delotet_plc_add_region: attribute and volume bound reach the mesh. */
#include "test.h"

int main(void)
{
    static const double inner[3] = {1.5, 1.5, 1.5}, outer[3] = {0.5, 0.5, 0.5};
    DelotetPlc *plc = nested_boxes();
    DelotetMesh *mesh;
    DelotetRegionsView regions;
    DelotetIndicesView of;
    DelotetTetsView tets;
    double sums[2] = {0, 0};
    size_t i;
    OK(delotet_plc_add_region(plc, outer, 10.5, 0, &error));
    OK(delotet_plc_add_region(plc, inner, -3, 0.25, &error));
    FAILS(INVALID, delotet_plc_add_region(plc, inner, NAN, 0, &error));
    FAILS(INVALID, delotet_plc_add_region(plc, inner, 0, NAN, &error));
    FAILS(INVALID, delotet_plc_add_region(plc, NULL, 0, 0, &error));
    FAILS(INVALID, delotet_plc_add_region(NULL, inner, 0, 0, &error));
    mesh = mesh_of(plc);
    regions = delotet_mesh_regions(mesh);
    of = delotet_mesh_tet_regions(mesh);
    tets = delotet_mesh_tets(mesh);
    CHECK(regions.count == 2 && of.count == tets.count);
    for (i = 0; i < tets.count; i++) {
        DelotetRegion region = *DELOTET_AT(DelotetRegion, regions, of.data[i]);
        CHECK(region.seed < 2);
        CHECK(region.attribute == (region.seed ? -3 : 10.5) && region.max_volume == (region.seed ? 0.25 : 0));
        sums[region.seed] += volume_of(delotet_mesh_points(mesh).data, tets.data + 4 * i);
    }
    CHECK(near(sums[0], 26) && near(sums[1], 1));
    delotet_mesh_free(mesh);
    return 0;
}
