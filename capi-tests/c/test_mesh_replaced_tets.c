/* delotet_mesh_replaced_tets: none on a cube; some on prisms with caps that are rough by units in the last place; ascending, counted, checked. */
#include "test.h"
#include <float.h>

static uint64_t state;

static unsigned next(unsigned count)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (unsigned)((state >> 33) % count);
}

/* A prism over an n-gon near an ellipse; its caps are fans of slivers. */
static DelotetPlc *rough_prism(uint32_t n)
{
    double xyz[6 * 40];
    uint32_t triangles[12 * 40], *t = triangles, i;
    DelotetPlc *plc = NULL;
    for (i = 0; i < n; i++) {
        const double angle = (i + 0.001 * next(500)) * 6.283185307179586 / n;
        uint32_t k;
        for (k = 0; k < 2; k++) {
            double *p = xyz + 3 * (i + k * n);
            p[0] = 3 * cos(angle);
            p[1] = sin(angle);
            p[2] = 1 + 0.25 * k + DBL_EPSILON * ((double)next(5) - 2);
        }
    }
    for (i = 0; i < n; i++) {
        const uint32_t j = (i + 1) % n;
        const uint32_t sides[6] = {i, j, n + j, i, n + j, n + i}, caps[6] = {0, j, i, n, n + i, n + j};
        memcpy(t, sides, sizeof sides);
        t += 6;
        if (i > 0 && j > 0) {
            memcpy(t, caps, sizeof caps);
            t += 6;
        }
    }
    OK(delotet_plc_new(xyz, 2 * n, &plc, &error));
    OK(delotet_plc_add_triangles(plc, triangles, NULL, (size_t)(t - triangles) / 3, &error));
    return plc;
}

int main(void)
{
    DelotetPlc *plc = cube();
    DelotetMesh *mesh = mesh_of(plc);
    size_t total = 0, i;
    uint32_t n;
    CHECK(delotet_mesh_replaced_tets(mesh).count == 0);
    CHECK(delotet_mesh_replaced_tets(NULL).data == NULL);
    delotet_mesh_free(mesh);
    for (n = 12; n < 20; n++) {
        DelotetError *error = NULL;
        DelotetStats stats;
        DelotetIndicesView replaced;
        DelotetStatus status;
        memset(&stats, 0, sizeof stats);
        stats.struct_size = sizeof stats;
        state = n;
        plc = rough_prism(n);
        mesh = NULL;
        status = delotet_tetrahedralize(plc, NULL, &mesh, &error);
        if (status == DELOTET_STATUS_OK) {
            replaced = delotet_mesh_replaced_tets(mesh);
            OK(delotet_mesh_check(mesh, plc, true, 10, &error));
            OK(delotet_mesh_stats(mesh, &stats, &error));
            CHECK(stats.replaced == replaced.count);
            for (i = 0; i < replaced.count; i++) {
                CHECK(replaced.data[i] < delotet_mesh_tets(mesh).count);
                CHECK(i == 0 || replaced.data[i - 1] < replaced.data[i]);
            }
            total += replaced.count;
        } else {
            CHECK(status == DELOTET_STATUS_ROUNDING && delotet_error_defects(error).count > 0);
        }
        delotet_error_free(error);
        delotet_mesh_free(mesh);
        delotet_plc_free(plc);
    }
    CHECK(total > 0);
    return 0;
}
