/* delotet_options_set_drop_unmeshed_points: points without tetrahedra are dropped, and the mesh still passes its check. */
#include "test.h"

int main(void)
{
    DelotetPlc *plc = cube_with_fin();
    DelotetOptions *options = delotet_options_new();
    DelotetMesh *mesh;
    OK(delotet_options_set_drop_unmeshed_points(options, true, &error));
    mesh = mesh_with(plc, options);
    CHECK(delotet_mesh_points(mesh).count == 8 && delotet_mesh_input_point_count(mesh) == 8);
    CHECK(delotet_mesh_unmeshed_points(mesh).count == 0 && delotet_mesh_unmeshed_subfaces(mesh).count == 0);
    CHECK(delotet_mesh_warning_count(mesh, DELOTET_WARNING_KIND_UNMESHED_POINT) == 3);
    CHECK(near(volume(mesh), 1));
    OK(delotet_mesh_check(mesh, plc, true, 10, &error));
    delotet_mesh_free(mesh);
    FAILS(INVALID, delotet_options_set_drop_unmeshed_points(NULL, true, &error));
    delotet_options_free(options);
    delotet_plc_free(plc);
    return 0;
}
