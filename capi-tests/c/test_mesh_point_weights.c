/* delotet_mesh_point_weights: those of the input; the first of equal points has the largest. */
#include "voronoi.h"

int main(void)
{
    const double xyz[18] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4, 1, 1, 1, 1, 1, 1};
    const double weights[6] = {0.5, 0, 0, -1, 0.25, 3};
    DelotetPlc *plc = NULL;
    DelotetMesh *mesh;
    DelotetDoublesView view;
    OK(delotet_plc_new(xyz, 6, &plc, &error));
    mesh = delaunay_of(plc);
    CHECK(delotet_mesh_point_weights(mesh).data == NULL && delotet_mesh_point_weights(mesh).count == 0);
    delotet_mesh_free(mesh);
    OK(delotet_plc_set_point_weights(plc, weights, 6, &error));
    mesh = delaunay_of(plc);
    view = delotet_mesh_point_weights(mesh);
    CHECK(view.count == 6 && view.width == 1 && view.data[0] == 0.5 && view.data[3] == -1);
    CHECK(view.data[4] == 3 && delotet_mesh_hidden_points(mesh).count == 0);
    delotet_mesh_free(mesh);
    delotet_plc_free(plc);
    CHECK(delotet_mesh_point_weights(NULL).count == 0);
    return 0;
}
