/* delotet_mesh_locate: inside, on the boundary, in the hole, outside, and not a number. */
#include "test.h"

int main(void)
{
    static const double seed[3] = {1.5, 1.5, 1.5};
    static const double xyz[18] = {0.3, 0.4, 0.5, 0, 1.25, 1.75, 1.5, 1.25, 1.5, 3.0000001, 1, 1, NAN, 0, 0, 3, 3, 3};
    DelotetPlc *plc = nested_boxes();
    DelotetMesh *mesh;
    uint32_t found[6], alone[6];
    double weights[24];
    size_t i, k, axis;
    OK(delotet_plc_add_hole(plc, seed, &error));
    mesh = mesh_of(plc);
    OK(delotet_mesh_locate(mesh, xyz, 6, found, weights, &error));
    OK(delotet_mesh_locate(mesh, xyz, 6, alone, NULL, &error));
    CHECK(memcmp(found, alone, sizeof found) == 0);
    for (i = 0; i < 6; i++) {
        int inside = i < 2 || i == 5;
        CHECK((found[i] != DELOTET_INVALID_INDEX) == inside);
        for (axis = 0; axis < 3; axis++) {
            double sum = 0;
            for (k = 0; inside && k < 4; k++) {
                CHECK(weights[4 * i + k] >= 0);
                sum += weights[4 * i + k] *
                       delotet_mesh_points(mesh).data[3 * delotet_mesh_tets(mesh).data[4 * found[i] + k] + axis];
            }
            CHECK(!inside || fabs(sum - xyz[3 * i + axis]) < 1e-12);
            CHECK(inside || isnan(weights[4 * i + axis]));
        }
    }
    OK(delotet_mesh_locate(mesh, NULL, 0, NULL, NULL, &error));
    FAILS(INVALID, delotet_mesh_locate(mesh, NULL, 1, found, weights, &error));
    FAILS(INVALID, delotet_mesh_locate(mesh, xyz, 1, NULL, weights, &error));
    FAILS(INVALID, delotet_mesh_locate(mesh, xyz, SIZE_MAX, found, weights, &error));
    FAILS(INVALID, delotet_mesh_locate(NULL, xyz, 1, found, weights, &error));
    delotet_mesh_free(mesh);
    return 0;
}
