/* delotet_voronoi_cell_facets: each facet is in the lists of its two cells, ascending. */
#include "voronoi.h"

int main(void)
{
    DelotetVoronoi *voronoi = voronoi_of_grid();
    DelotetVoronoiFacetsView facets = delotet_voronoi_facets(voronoi);
    DelotetVoronoiCellsView cells = delotet_voronoi_cells(voronoi);
    DelotetIndicesView list = delotet_voronoi_cell_facets(voronoi);
    size_t i, k;
    CHECK(list.count == 2 * facets.count);
    for (i = 0; i < cells.count; i++) {
        const DelotetVoronoiCell *cell = DELOTET_AT(DelotetVoronoiCell, cells, i);
        for (k = 0; k < cell->count; k++) {
            uint32_t f = list.data[cell->first + k];
            const DelotetVoronoiFacet *facet = DELOTET_AT(DelotetVoronoiFacet, facets, f);
            CHECK(facet->cells[0] == i || facet->cells[1] == i);
            CHECK(k == 0 || list.data[cell->first + k - 1] < f);
        }
    }
    CHECK(delotet_voronoi_cell_facets(NULL).data == NULL && delotet_voronoi_cell_facets(NULL).count == 0);
    delotet_voronoi_free(voronoi);
    return 0;
}
