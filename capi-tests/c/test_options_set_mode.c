/* delotet_options_set_mode: Delaunay alone ignores the facets; unknown modes are refused. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = nested_boxes();
    DelotetMesh *mesh;
    CHECK(delotet_options_set_mode(options, 3) == INVALID);
    CHECK(delotet_options_set_mode(options, UINT32_MAX) == INVALID);
    CHECK(delotet_options_set_mode(NULL, DELOTET_MODE_DELAUNAY) == INVALID);
    CHECK(delotet_options_set_mode(options, DELOTET_MODE_DELAUNAY) == DELOTET_STATUS_OK);
    mesh = mesh_with(plc, options);
    CHECK(delotet_mesh_subfaces(mesh).count == 0);
    CHECK(delotet_mesh_points(mesh).count == 16);
    CHECK(near(volume(mesh), 27));
    delotet_mesh_free(mesh);
    CHECK(delotet_options_set_mode(options, DELOTET_MODE_CONSTRAINED) == DELOTET_STATUS_OK);
    mesh = mesh_with(plc, options);
    CHECK(delotet_mesh_subfaces(mesh).count >= 24);
    delotet_mesh_free(mesh);
    delotet_plc_free(plc);
    delotet_options_free(options);
    return 0;
}
