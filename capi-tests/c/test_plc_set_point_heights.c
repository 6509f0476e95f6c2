/* delotet_plc_set_point_heights: the squares are the heights of no weights; a lower point hides others. */
#include "voronoi.h"

int main(void)
{
    enum { COUNT = SIDE * SIDE * SIDE };
    double heights[COUNT];
    DelotetPlc *plc = grid_points();
    DelotetMesh *plain = delaunay_of(plc), *mesh;
    DelotetPointsView points = delotet_mesh_points(plain);
    size_t i;
    for (i = 0; i < COUNT; i++) {
        const double *p = points.data + 3 * i;
        heights[i] = p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
    }
    OK(delotet_plc_set_point_heights(plc, heights, COUNT, &error));
    mesh = delaunay_of(plc);
    CHECK(delotet_mesh_tets(mesh).count == delotet_mesh_tets(plain).count);
    CHECK(delotet_mesh_hidden_points(mesh).count == 0 && near(volume(mesh), 27));
    delotet_mesh_free(mesh);
    heights[21] -= 100;
    OK(delotet_plc_set_point_heights(plc, heights, COUNT, &error));
    mesh = delaunay_of(plc);
    /* Only the points on the hull and this one are left. */
    CHECK(delotet_mesh_hidden_points(mesh).count == 7);
    delotet_mesh_free(mesh);
    delotet_mesh_free(plain);
    heights[3] = INFINITY;
    FAILS(INVALID, delotet_plc_set_point_heights(plc, heights, COUNT, &error));
    FAILS(INVALID, delotet_plc_set_point_heights(plc, heights, 3, &error));
    FAILS(INVALID, delotet_plc_set_point_heights(NULL, heights, COUNT, &error));
    OK(delotet_plc_set_point_heights(plc, NULL, 0, &error));
    CHECK(delotet_plc_point_weights(plc).data == NULL);
    delotet_plc_free(plc);
    return 0;
}
