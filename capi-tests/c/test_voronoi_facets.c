/* delotet_voronoi_facets: one per edge, between its ends; unbounded on the hull. */
#include "voronoi.h"

int main(void)
{
    DelotetPlc *plc = grid_points();
    DelotetMesh *mesh = delaunay_of(plc);
    DelotetVoronoi *voronoi = voronoi_of(mesh);
    DelotetVoronoiFacetsView facets = delotet_voronoi_facets(voronoi);
    DelotetEdgesView edges;
    size_t i, first = 0;
    OK(delotet_mesh_edges(mesh, &edges, &error));
    CHECK(facets.count == edges.count && facets.stride == sizeof(DelotetVoronoiFacet));
    for (i = 0; i < facets.count; i++) {
        const DelotetVoronoiFacet *facet = DELOTET_AT(DelotetVoronoiFacet, facets, i);
        CHECK(memcmp(facet->cells, DELOTET_AT(DelotetEdge, edges, i)->ends, sizeof facet->cells) == 0);
        CHECK(facet->first == first && facet->count >= 2);
        if (is_inner(facet->cells[0]) || is_inner(facet->cells[1]))
            CHECK(facet->bounded && facet->count >= 3);
        first += facet->count;
    }
    CHECK(first == delotet_voronoi_facet_edges(voronoi).count);
    CHECK(delotet_voronoi_facets(NULL).first == NULL && delotet_voronoi_facets(NULL).count == 0);
    delotet_voronoi_free(voronoi);
    delotet_mesh_free(mesh);
    delotet_plc_free(plc);
    return 0;
}
