/* delotet_mesh_hidden_points: ascending, unmeshed, without equal points; once they are left out, the map tells. */
#include "voronoi.h"

int main(void)
{
    const double xyz[21] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4, 1, 1, 1, 1, 1, 0.5, 1, 1, 1};
    const double weights[7] = {0, 0, 0, 0, 2, -5, 1};
    DelotetPlc *plc = NULL;
    DelotetOptions *options = delotet_options_new();
    DelotetMesh *mesh;
    DelotetIndicesView hidden, map;
    OK(delotet_plc_new(xyz, 7, &plc, &error));
    mesh = delaunay_of(plc);
    CHECK(delotet_mesh_hidden_points(mesh).data == NULL && delotet_mesh_hidden_points(mesh).count == 0);
    delotet_mesh_free(mesh);
    OK(delotet_plc_set_point_weights(plc, weights, 7, &error));
    mesh = delaunay_of(plc);
    hidden = delotet_mesh_hidden_points(mesh);
    CHECK(hidden.count == 1 && hidden.data[0] == 5);
    CHECK(delotet_mesh_unmeshed_points(mesh).count == 2 && delotet_mesh_unmeshed_points(mesh).data[1] == 6);
    CHECK(delotet_mesh_warning_count(mesh, DELOTET_WARNING_KIND_UNMESHED_POINT) == 0);
    delotet_mesh_free(mesh);
    OK(delotet_options_set_mode(options, DELOTET_MODE_DELAUNAY, &error));
    OK(delotet_options_set_drop_unmeshed_points(options, true, &error));
    mesh = mesh_with(plc, options);
    map = delotet_mesh_point_map(mesh);
    CHECK(delotet_mesh_hidden_points(mesh).count == 0 && delotet_mesh_points(mesh).count == 5);
    CHECK(map.data[5] == DELOTET_INVALID_INDEX && map.data[6] == 4);
    CHECK(delotet_mesh_point_weights(mesh).count == 5 && delotet_mesh_point_weights(mesh).data[4] == 2);
    delotet_mesh_free(mesh);
    delotet_options_free(options);
    delotet_plc_free(plc);
    CHECK(delotet_mesh_hidden_points(NULL).count == 0);
    return 0;
}
