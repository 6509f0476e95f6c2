/* delotet_plc_add_facet: facets with a hole: a box with a tunnel. */
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
    static const uint32_t wrong[4] = {0, 1, 2, 16};
    static const size_t ends[2] = {4, 8};
    double xyz[48];
    DelotetPlc *plc = NULL;
    DelotetMesh *mesh;
    frame_points(xyz);
    OK(delotet_plc_new(xyz, 16, &plc, &error));
    FAILS(DELOTET_STATUS_INDEX_OUT_OF_RANGE, delotet_plc_add_facet(plc, wrong, ends, 1, 0, &error));
    FAILS(INVALID, delotet_plc_add_facet(plc, NULL, ends, 1, 0, &error));
    FAILS(INVALID, delotet_plc_add_facet(plc, bottom, NULL, 1, 0, &error));
    FAILS(INVALID, delotet_plc_add_facet(NULL, bottom, ends, 1, 0, &error));
    CHECK(delotet_plc_facet_count(plc) == 0);
    OK(delotet_plc_add_facet(plc, bottom, ends, 2, 1, &error));
    OK(delotet_plc_add_facet(plc, top, ends, 2, 2, &error));
    add_walls(plc);
    mesh = mesh_of(plc);
    CHECK(near(volume(mesh), 24));
    delotet_mesh_free(mesh);
    return 0;
}
