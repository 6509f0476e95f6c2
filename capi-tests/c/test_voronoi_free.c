/* delotet_voronoi_free: the diagram needs its mesh no longer; NULL is ignored. */
#include "voronoi.h"

int main(void)
{
    DelotetVoronoi *voronoi = voronoi_of_grid();
    CHECK(delotet_voronoi_vertices(voronoi).count == 6 * 27 || delotet_voronoi_vertices(voronoi).count >= 5 * 27);
    delotet_voronoi_free(voronoi);
    delotet_voronoi_free(NULL);
    return 0;
}
