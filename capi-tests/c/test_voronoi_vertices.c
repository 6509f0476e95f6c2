/* delotet_voronoi_vertices: one per tetrahedron, exactly the centres of the cubes of a grid. */
#include "voronoi.h"

int main(void)
{
    DelotetPlc *plc = grid_points();
    DelotetMesh *mesh = delaunay_of(plc);
    DelotetVoronoi *voronoi = voronoi_of(mesh);
    DelotetPointsView vertices = delotet_voronoi_vertices(voronoi), points = delotet_mesh_points(mesh);
    DelotetTetsView tets = delotet_mesh_tets(mesh);
    size_t i, k, c;
    CHECK(vertices.count == tets.count);
    for (i = 0; i < tets.count; i++)
        for (k = 0; k < 3; k++) {
            double low = INFINITY;
            for (c = 0; c < 4; c++)
                low = fmin(low, points.data[3 * tets.data[4 * i + c] + k]);
            CHECK(vertices.data[3 * i + k] == low + 0.5);
        }
    CHECK(delotet_voronoi_vertices(NULL).data == NULL && delotet_voronoi_vertices(NULL).count == 0);
    delotet_voronoi_free(voronoi);
    delotet_mesh_free(mesh);
    delotet_plc_free(plc);
    return 0;
}
