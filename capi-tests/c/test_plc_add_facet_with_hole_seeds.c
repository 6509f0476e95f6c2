/* delotet_plc_add_facet_with_hole_seeds: the same tunnel by TetGen's rule. */
#include "test.h"

/* A box from 0 to 3 with a square tunnel through it along z, from 1 to 2. Corners 0 to 7: outer, 8 to 15: tunnel. */
static void frame_points(double *xyz)
{
    int i;
    box_points(xyz, 0, 3);
    box_points(xyz + 24, 1, 2);
    for (i = 8; i < 16; i++)
        xyz[3 * i + 2] = i & 4 ? 3 : 0;
}

/* The eight side walls, outer and inner. */
static void add_walls(DelotetPlc *plc)
{
    static const uint32_t corners[32] = {0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5,
                                         8, 12, 13, 9, 10, 11, 15, 14, 8, 10, 14, 12, 9, 13, 15, 11};
    static const size_t ends[8] = {4, 8, 12, 16, 20, 24, 28, 32};
    OK(delotet_plc_add_polygons(plc, corners, ends, NULL, 8, &error));
}

int main(void)
{
    static const uint32_t bottom[8] = {0, 2, 3, 1, 8, 10, 11, 9}, top[8] = {4, 5, 7, 6, 12, 13, 15, 14};
    static const size_t ends[2] = {4, 8};
    static const double low[3] = {1.5, 1.5, 0}, high[3] = {1.5, 1.5, 3};
    double xyz[48];
    DelotetPlc *plc = NULL;
    DelotetMesh *mesh;
    frame_points(xyz);
    OK(delotet_plc_new(xyz, 16, &plc, &error));
    FAILS(INVALID, delotet_plc_add_facet_with_hole_seeds(plc, bottom, ends, 2, NULL, 1, 0, &error));
    FAILS(INVALID, delotet_plc_add_facet_with_hole_seeds(plc, NULL, ends, 2, low, 1, 0, &error));
    FAILS(INVALID, delotet_plc_add_facet_with_hole_seeds(NULL, bottom, ends, 2, low, 1, 0, &error));
    FAILS(INVALID, delotet_plc_add_facet_with_hole_seeds(plc, bottom, ends, 2, low, SIZE_MAX, 0, &error));
    CHECK(delotet_plc_facet_count(plc) == 0);
    OK(delotet_plc_add_facet_with_hole_seeds(plc, bottom, ends, 2, low, 1, 1, &error));
    OK(delotet_plc_add_facet_with_hole_seeds(plc, top, ends, 2, high, 1, 2, &error));
    add_walls(plc);
    mesh = mesh_of(plc);
    CHECK(near(volume(mesh), 24));
    delotet_mesh_free(mesh);
    /* Without seeds inner polygons constrain only: both ends of the tunnel are closed, and it is meshed. */
    OK(delotet_plc_new(xyz, 16, &plc, &error));
    OK(delotet_plc_add_facet_with_hole_seeds(plc, bottom, ends, 2, NULL, 0, 1, &error));
    OK(delotet_plc_add_facet_with_hole_seeds(plc, top, ends, 2, NULL, 0, 2, &error));
    add_walls(plc);
    mesh = mesh_of(plc);
    CHECK(near(volume(mesh), 27));
    delotet_mesh_free(mesh);
    return 0;
}
