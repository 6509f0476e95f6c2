/* delotet_mesh_points: input points first, bit for bit, then Steiner points. */
#include "test.h"

int main(void)
{
    DelotetPlc *plc = twisted_prism();
    DelotetMesh *mesh = mesh_with(plc, NULL);
    DelotetPointsView points = delotet_mesh_points(mesh);
    CHECK(points.count == 6 + delotet_mesh_steiner_points(mesh).count && points.count > 6);
    CHECK(memcmp(points.data, delotet_plc_points(plc).data, 18 * sizeof(double)) == 0);
    CHECK(delotet_mesh_points(mesh).data == points.data);
    CHECK(delotet_mesh_points(NULL).data == NULL && delotet_mesh_points(NULL).count == 0);
    delotet_mesh_free(mesh);
    delotet_plc_free(plc);
    return 0;
}
