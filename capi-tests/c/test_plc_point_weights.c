/* delotet_plc_point_weights: what was set last, weights or heights; a copy has them too. */
#include "voronoi.h"

int main(void)
{
    const double weights[4] = {1, -2, 0, 3.5}, heights[4] = {5, 6, 7, 8};
    const double xyz[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    DelotetPlc *plc = NULL, *copy = NULL;
    OK(delotet_plc_new(xyz, 4, &plc, &error));
    CHECK(delotet_plc_point_weights(plc).data == NULL && delotet_plc_point_weights(plc).count == 0);
    OK(delotet_plc_set_point_weights(plc, weights, 4, &error));
    CHECK(delotet_plc_point_weights(plc).count == 4 && delotet_plc_point_weights(plc).width == 1);
    CHECK(memcmp(delotet_plc_point_weights(plc).data, weights, sizeof weights) == 0);
    OK(delotet_plc_set_point_heights(plc, heights, 4, &error));
    OK(delotet_plc_clone(plc, &copy, &error));
    delotet_plc_free(plc);
    CHECK(memcmp(delotet_plc_point_weights(copy).data, heights, sizeof heights) == 0);
    delotet_plc_free(copy);
    CHECK(delotet_plc_point_weights(NULL).count == 0);
    return 0;
}
