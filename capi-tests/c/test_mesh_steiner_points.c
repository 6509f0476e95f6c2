/* delotet_mesh_steiner_points: ends, parameter and exactness agree with the coordinates. */
#include "test.h"

int main(void)
{
    DelotetMesh *mesh = mesh_of(twisted_prism());
    DelotetSteinerView steiner = delotet_mesh_steiner_points(mesh);
    const double *xyz = delotet_mesh_points(mesh).data;
    size_t i;
    size_t axis;
    CHECK(steiner.count > 0);
    for (i = 0; i < steiner.count; i++) {
        DelotetSteinerPoint point = *DELOTET_AT(DelotetSteinerPoint, steiner, i);
        CHECK(point.ends[0] < 6 && point.ends[1] < 6 && point.t > 0 && point.t < 1);
        CHECK(point.segment == DELOTET_INVALID_INDEX);
        for (axis = 0; axis < 3; axis++) {
            double a = xyz[3 * point.ends[0] + axis], b = xyz[3 * point.ends[1] + axis];
            CHECK(fabs(a + point.t * (b - a) - xyz[3 * (6 + i) + axis]) < 1e-12);
        }
    }
    CHECK(delotet_mesh_steiner_points(NULL).first == NULL);
    delotet_mesh_free(mesh);
    return 0;
}
