/* delotet_options_set_points_sorted: a hint: the mesh is valid in any case. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = cube();
    DelotetMesh *mesh;
    OK(delotet_options_set_points_sorted(options, true, &error));
    mesh = mesh_with(plc, options);
    CHECK(near(volume(mesh), 1));
    delotet_mesh_free(mesh);
    FAILS(INVALID, delotet_options_set_points_sorted(NULL, true, &error));
    delotet_plc_free(plc);
    delotet_options_free(options);
    return 0;
}
