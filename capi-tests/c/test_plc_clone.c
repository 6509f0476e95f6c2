/* delotet_plc_clone: a copy with everything in the PLC, which stays valid without it. */
#include "test.h"

int main(void)
{
    static const double seed[3] = {0.5, 0.5, 0.5}, attributes[8] = {0, 1, 2, 3, 4, 5, 6, 7};
    static const int32_t markers[8] = {1, 2, 3, 4, 5, 6, 7, 8};
    DelotetPlc *plc = cube(), *copy = NULL;
    DelotetMesh *mesh;
    OK(delotet_plc_add_segment(plc, 0, 7, 3, &error));
    OK(delotet_plc_add_region(plc, seed, 5, 0.25, &error));
    OK(delotet_plc_set_point_attributes(plc, attributes, 1, &error));
    OK(delotet_plc_set_point_markers(plc, markers, &error));
    OK(delotet_plc_clone(plc, &copy, &error));
    OK(delotet_plc_add_segment(plc, 1, 6, 4, &error));
    delotet_plc_free(plc);
    CHECK(delotet_plc_segment_count(copy) == 1 && delotet_plc_facet_count(copy) == 12);
    CHECK(delotet_plc_facet_marker(copy, 11) == 6);
    CHECK(memcmp(delotet_plc_point_markers(copy).data, markers, sizeof markers) == 0);
    CHECK(memcmp(delotet_plc_point_attributes(copy).data, attributes, sizeof attributes) == 0);
    CHECK(DELOTET_AT(DelotetRegionSeed, delotet_plc_regions(copy), 0)->max_volume == 0.25);
    mesh = mesh_with(copy, NULL);
    CHECK(near(volume(mesh), 1));
    CHECK(DELOTET_AT(DelotetRegion, delotet_mesh_regions(mesh), 0)->attribute == 5);
    delotet_mesh_free(mesh);
    FAILS(INVALID, delotet_plc_clone(NULL, &plc, &error));
    CHECK(plc == NULL);
    FAILS(INVALID, delotet_plc_clone(copy, NULL, &error));
    delotet_plc_free(copy);
    return 0;
}
