/* delotet_voronoi_edges: one per face, between its tetrahedra; rays go outward with length 1. */
#include "voronoi.h"

int main(void)
{
    DelotetPlc *plc = grid_points();
    DelotetMesh *mesh = delaunay_of(plc);
    DelotetVoronoi *voronoi = voronoi_of(mesh);
    DelotetVoronoiEdgesView edges = delotet_voronoi_edges(voronoi);
    DelotetPointsView vertices = delotet_voronoi_vertices(voronoi);
    DelotetFacesView faces;
    size_t i, rays = 0;
    OK(delotet_mesh_faces(mesh, &faces, &error));
    CHECK(edges.count == faces.count && edges.stride == sizeof(DelotetVoronoiEdge));
    for (i = 0; i < edges.count; i++) {
        const DelotetVoronoiEdge *edge = DELOTET_AT(DelotetVoronoiEdge, edges, i);
        const double *d = edge->direction;
        CHECK(memcmp(edge->vertices, DELOTET_AT(DelotetFace, faces, i)->tets, sizeof edge->vertices) == 0);
        if (edge->vertices[1] != DELOTET_INVALID_INDEX) {
            CHECK(d[0] == 0 && d[1] == 0 && d[2] == 0);
            continue;
        }
        rays++;
        /* Along one axis, away from the middle of the grid. */
        CHECK(fabs(d[0]) + fabs(d[1]) + fabs(d[2]) == 1);
        {
            const double *at = vertices.data + 3 * edge->vertices[0];
            CHECK((at[0] - 1.5) * d[0] + (at[1] - 1.5) * d[1] + (at[2] - 1.5) * d[2] == 1);
        }
    }
    CHECK(rays == 2 * 6 * (SIDE - 1) * (SIDE - 1));
    CHECK(delotet_voronoi_edges(NULL).first == NULL && delotet_voronoi_edges(NULL).count == 0);
    delotet_voronoi_free(voronoi);
    delotet_mesh_free(mesh);
    delotet_plc_free(plc);
    return 0;
}
