/* delotet_plc_point_sizes: empty unless set; points that are added later have no wish, and copies have them all. */
#include "test.h"

int main(void)
{
    static const double sizes[8] = {1, 2, 3, 4, 5, 6, 7, 0.5}, more[6] = {5, 5, 5, 6, 6, 6};
    DelotetPlc *plc = cube(), *copy = NULL;
    DelotetDoublesView view = delotet_plc_point_sizes(plc);
    CHECK(view.data == NULL && view.count == 0 && delotet_plc_point_sizes(NULL).data == NULL);
    OK(delotet_plc_set_point_sizes(plc, sizes, 8, &error));
    view = delotet_plc_point_sizes(plc);
    CHECK(view.count == 8 && view.width == 1 && memcmp(view.data, sizes, sizeof sizes) == 0);
    OK(delotet_plc_add_points(plc, more, 2, NULL, &error));
    OK(delotet_plc_clone(plc, &copy, &error));
    delotet_plc_free(plc);
    view = delotet_plc_point_sizes(copy);
    CHECK(view.count == 10 && memcmp(view.data, sizes, sizeof sizes) == 0);
    CHECK(isinf(view.data[8]) && isinf(view.data[9]) && view.data[9] > 0);
    delotet_plc_free(copy);
    return 0;
}
