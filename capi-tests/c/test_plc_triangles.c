/* delotet_plc_triangles: those before the first other facet; later ones are read as rings. */
#include "test.h"

int main(void)
{
    static const uint32_t square[4] = {4, 5, 7, 6};
    static const size_t end[1] = {4};
    DelotetPlc *plc = cube();
    CHECK(delotet_plc_triangles(plc).count == 12 && delotet_plc_triangles(plc).width == 3);
    CHECK(memcmp(delotet_plc_triangles(plc).data, BOX, sizeof BOX) == 0);
    OK(delotet_plc_add_polygons(plc, square, end, NULL, 1, &error));
    OK(delotet_plc_add_triangles(plc, BOX, NULL, 1, &error));
    CHECK(delotet_plc_triangles(plc).count == 12 && delotet_plc_facet_count(plc) == 14);
    CHECK(memcmp(delotet_plc_facet_ring(plc, 13, 0).data, BOX, 12) == 0);
    CHECK(delotet_plc_triangles(NULL).count == 0 && delotet_plc_triangles(NULL).data == NULL);
    delotet_plc_free(plc);
    return 0;
}
