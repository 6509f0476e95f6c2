/* delotet_tetrahedralize: a cube, the same twice; what cannot be meshed; misuse. */
#include "test.h"

int main(void)
{
    static const double flat[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    DelotetPlc *plc = cube(), *bad = pierced(), *empty = NULL;
    DelotetMesh *a = mesh_with(plc, NULL), *b = mesh_with(plc, NULL), *none = a;
    CHECK(delotet_mesh_points(a).count == 8);
    CHECK(memcmp(delotet_mesh_tets(a).data, delotet_mesh_tets(b).data, 16 * delotet_mesh_tets(a).count) == 0);
    FAILS(DELOTET_STATUS_SELF_INTERSECTION, delotet_tetrahedralize(bad, NULL, &none, &error));
    CHECK(none == NULL);
    CHECK(delotet_tetrahedralize(bad, NULL, &none, NULL) == DELOTET_STATUS_SELF_INTERSECTION);
    FAILS(INVALID, delotet_tetrahedralize(NULL, NULL, &none, &error));
    FAILS(INVALID, delotet_tetrahedralize(plc, NULL, NULL, &error));
    OK(delotet_plc_new(flat, 4, &empty, &error));
    FAILS(DELOTET_STATUS_DEGENERATE_INPUT, delotet_tetrahedralize(empty, NULL, &none, &error));
    delotet_plc_free(empty);
    delotet_plc_free(plc);
    delotet_plc_free(bad);
    delotet_mesh_free(a);
    delotet_mesh_free(b);
    return 0;
}
