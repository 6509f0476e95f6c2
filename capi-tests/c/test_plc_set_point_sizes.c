/* delotet_plc_set_point_sizes: one each or none; what is no length is refused and changes nothing; they are wishes for filling. */
#include "test.h"

int main(void)
{
    enum { COUNT = 6 * GRID * GRID + 2 };
    double sizes[COUNT + 1];
    DelotetPlc *plc = grid_box();
    DelotetOptions *options = delotet_options_new();
    size_t none;
    int i;
    OK(delotet_options_set_mode(options, DELOTET_MODE_PRESERVE, &error));
    OK(delotet_options_set_size(options, 3, &error));
    none = points_in_grid(plc, options);
    for (i = 0; i <= COUNT; i++)
        sizes[i] = i == 3 ? INFINITY : 0.5;
    OK(delotet_plc_set_point_sizes(plc, sizes, COUNT, &error));
    CHECK(delotet_plc_point_sizes(plc).count == COUNT);
    sizes[7] = 0;
    FAILS(INVALID, delotet_plc_set_point_sizes(plc, sizes, COUNT, &error));
    sizes[7] = -1;
    FAILS(INVALID, delotet_plc_set_point_sizes(plc, sizes, COUNT, &error));
    sizes[7] = NAN;
    FAILS(INVALID, delotet_plc_set_point_sizes(plc, sizes, COUNT, &error));
    FAILS(INVALID, delotet_plc_set_point_sizes(plc, sizes, 7, &error));
    FAILS(INVALID, delotet_plc_set_point_sizes(plc, sizes, COUNT + 1, &error));
    FAILS(INVALID, delotet_plc_set_point_sizes(plc, NULL, COUNT, &error));
    FAILS(INVALID, delotet_plc_set_point_sizes(plc, sizes, SIZE_MAX / 4, &error));
    FAILS(INVALID, delotet_plc_set_point_sizes(NULL, sizes, COUNT, &error));
    CHECK(delotet_plc_point_sizes(plc).data[7] == 0.5);
    CHECK(points_in_grid(plc, options) > none);
    OK(delotet_plc_set_point_sizes(plc, NULL, 0, &error));
    CHECK(delotet_plc_point_sizes(plc).data == NULL && points_in_grid(plc, options) == none);
    delotet_plc_free(plc);
    delotet_options_free(options);
    return 0;
}
