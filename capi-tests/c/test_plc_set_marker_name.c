/* delotet_plc_set_marker_name: named, renamed, unnamed; files keep the name. */
#include "test.h"

int main(void)
{
    DelotetPlc *plc = cube(), *back = NULL, *copy = NULL;
    OK(delotet_plc_set_marker_name(plc, 6, "inlet", &error));
    OK(delotet_plc_set_marker_name(plc, 2, "wall", &error));
    OK(delotet_plc_set_marker_name(plc, 6, " outlet\nsecond line", &error));
    CHECK(strcmp(delotet_plc_marker_name(plc, 6), "outlet") == 0 && strcmp(delotet_plc_marker_name(plc, 2), "wall") == 0);
    OK(delotet_plc_clone(plc, &copy, &error));
    OK(delotet_plc_write(plc, "marker_name.obj", &error));
    OK(delotet_plc_read("marker_name.obj", &back, &error));
    CHECK(remove("marker_name.obj") == 0);
    CHECK(strcmp(delotet_plc_marker_name(back, delotet_plc_facet_marker(back, 11)), "outlet") == 0);
    OK(delotet_plc_set_marker_name(plc, 6, "", &error));
    OK(delotet_plc_set_marker_name(plc, 2, NULL, &error));
    OK(delotet_plc_set_marker_name(plc, 3, NULL, &error));
    CHECK(delotet_plc_marker_name_count(plc) == 0 && delotet_plc_marker_name(plc, 6) == NULL);
    CHECK(delotet_plc_marker_name_count(copy) == 2 && strcmp(delotet_plc_marker_name(copy, 6), "outlet") == 0);
    FAILS(INVALID, delotet_plc_set_marker_name(plc, 1, "\xff", &error));
    FAILS(INVALID, delotet_plc_set_marker_name(NULL, 1, "a", &error));
    delotet_plc_free(plc);
    delotet_plc_free(back);
    delotet_plc_free(copy);
    return 0;
}
