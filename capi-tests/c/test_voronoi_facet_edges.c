/* delotet_voronoi_facet_edges: each edge is on three facets; around a facet they share their ends; rays are at the ends of a list. */
#include "voronoi.h"

int main(void)
{
    DelotetVoronoi *voronoi = voronoi_of_grid();
    DelotetVoronoiFacetsView facets = delotet_voronoi_facets(voronoi);
    DelotetVoronoiEdgesView edges = delotet_voronoi_edges(voronoi);
    DelotetIndicesView list = delotet_voronoi_facet_edges(voronoi);
    size_t i, k;
    CHECK(list.count == 3 * edges.count);
    for (i = 0; i < facets.count; i++) {
        const DelotetVoronoiFacet *facet = DELOTET_AT(DelotetVoronoiFacet, facets, i);
        for (k = 0; k < facet->count; k++) {
            uint32_t next = (uint32_t)((k + 1) % facet->count);
            const uint32_t *a = DELOTET_AT(DelotetVoronoiEdge, edges, list.data[facet->first + k])->vertices;
            const uint32_t *b = DELOTET_AT(DelotetVoronoiEdge, edges, list.data[facet->first + next])->vertices;
            int is_ray = a[1] == DELOTET_INVALID_INDEX;
            CHECK(is_ray == (!facet->bounded && (k == 0 || k + 1 == facet->count)));
            if (facet->bounded || next != 0)
                CHECK(a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || (!is_ray && a[1] == b[1]));
        }
    }
    CHECK(delotet_voronoi_facet_edges(NULL).data == NULL && delotet_voronoi_facet_edges(NULL).count == 0);
    delotet_voronoi_free(voronoi);
    return 0;
}
