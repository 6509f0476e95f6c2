/* delotet_plc_add_hole: the inner box is left out. */
#include "test.h"

int main(void)
{
    static const double seed[3] = {1.5, 1.5, 1.5};
    DelotetPlc *plc = nested_boxes();
    DelotetMesh *mesh = mesh_with(plc, NULL);
    CHECK(near(volume(mesh), 27));
    delotet_mesh_free(mesh);
    OK(delotet_plc_add_hole(plc, seed, &error));
    FAILS(INVALID, delotet_plc_add_hole(plc, NULL, &error));
    FAILS(INVALID, delotet_plc_add_hole(NULL, seed, &error));
    mesh = mesh_with(plc, NULL);
    CHECK(near(volume(mesh), 26));
    delotet_mesh_free(mesh);
    delotet_plc_free(plc);
    return 0;
}
