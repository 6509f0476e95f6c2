/* delotet_voronoi_cells: one per point, bounded inside; none for hidden and for equal points. */
#include "voronoi.h"

int main(void)
{
    DelotetPlc *plc = grid_points();
    double weights[SIDE * SIDE * SIDE + 1] = {0};
    const double again[3] = {2, 1, 0};
    DelotetMesh *mesh;
    DelotetVoronoi *voronoi = voronoi_of_grid();
    DelotetVoronoiCellsView cells = delotet_voronoi_cells(voronoi);
    DelotetIndicesView hidden;
    size_t i, first = 0, next = 0;
    CHECK(cells.count == SIDE * SIDE * SIDE && cells.stride == sizeof(DelotetVoronoiCell));
    for (i = 0; i < cells.count; i++) {
        const DelotetVoronoiCell *cell = DELOTET_AT(DelotetVoronoiCell, cells, i);
        CHECK(cell->bounded == is_inner(i) && cell->first == first && cell->count >= (is_inner(i) ? 6 : 3));
        first += cell->count;
    }
    delotet_voronoi_free(voronoi);
    OK(delotet_plc_add_points(plc, again, 1, NULL, &error));
    weights[21] = 4;
    OK(delotet_plc_set_point_weights(plc, weights, SIDE * SIDE * SIDE + 1, &error));
    mesh = delaunay_of(plc);
    voronoi = voronoi_of(mesh);
    cells = delotet_voronoi_cells(voronoi);
    hidden = delotet_mesh_unmeshed_points(mesh);
    CHECK(hidden.count > 1 && hidden.data[hidden.count - 1] == cells.count - 1);
    for (i = 0; i < cells.count; i++) {
        const DelotetVoronoiCell *cell = DELOTET_AT(DelotetVoronoiCell, cells, i);
        int is_hidden = next < hidden.count && hidden.data[next] == i;
        next += (size_t)is_hidden;
        CHECK((cell->count == 0) == is_hidden && (!is_hidden || !cell->bounded));
    }
    CHECK(delotet_voronoi_cells(NULL).first == NULL && delotet_voronoi_cells(NULL).count == 0);
    delotet_voronoi_free(voronoi);
    delotet_mesh_free(mesh);
    delotet_plc_free(plc);
    return 0;
}
