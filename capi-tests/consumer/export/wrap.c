#include "wrap.h"
#include <delotet/delotet.h>

unsigned wrap_cube(void)
{
    const double xyz[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1};
    const uint32_t squares[] = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
    const size_t ends[] = {4, 8, 12, 16, 20, 24};
    DelotetPlc *plc = NULL;
    DelotetMesh *mesh = NULL;
    unsigned count = 0;

    if (!delotet_plc_new(xyz, 8, &plc, NULL) && !delotet_plc_add_polygons(plc, squares, ends, NULL, 6, NULL) &&
        !delotet_tetrahedralize(plc, NULL, &mesh, NULL))
        count = (unsigned)delotet_mesh_tets(mesh).count;
    delotet_mesh_free(mesh);
    delotet_plc_free(plc);
    return count;
}
