/* delotet_mesh_steiner_points: ends, parameter and exactness agree with the coordinates. */
#include "test.h"

/* A prism with a slanted top, so that points on that facet are not doubles: points on facets, edges and inside. */
static void refined(void)
{
    static const uint32_t rings[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = NULL;
    DelotetMesh *mesh;
    DelotetSteinerView steiner;
    const double *points;
    const size_t corners = 4;
    double xyz[24];
    size_t i, axis, on_facets = 0, on_edges = 0, inside = 0, plane_given = 0;
    box_points(xyz, 0, 1);
    xyz[3 * 5 + 2] = xyz[3 * 7 + 2] = 1.3; /* The top is z = 1 + 0.3 x. */
    OK(delotet_plc_new(xyz, 8, &plc, &error));
    for (i = 0; i < 6; i++)
        OK(delotet_plc_add_facet(plc, rings[i], &corners, 1, 1, &error));
    OK(delotet_options_set_quality(options, 2, &error));
    OK(delotet_options_set_size(options, 0.25, &error));
    mesh = mesh_with(plc, options);
    OK(delotet_mesh_check(mesh, plc, true, 10, &error));
    CHECK(fabs(volume(mesh) - 1.15) < 1e-9);
    steiner = delotet_mesh_steiner_points(mesh);
    points = delotet_mesh_points(mesh).data;
    for (i = 0; i < steiner.count; i++) {
        const DelotetSteinerPoint point = *DELOTET_AT(DelotetSteinerPoint, steiner, i);
        const double *at = points + 3 * (8 + i);
        if (point.facet != DELOTET_INVALID_INDEX) {
            const uint32_t *ring = rings[point.facet];
            const double *a = xyz + 3 * ring[0], *b = xyz + 3 * ring[1], *c = xyz + 3 * ring[3];
            double u[3], v[3], w[3];
            on_facets++;
            CHECK(point.facet < 6 && point.segment == DELOTET_INVALID_INDEX);
            for (axis = 0; axis < 3; axis++) {
                u[axis] = b[axis] - a[axis];
                v[axis] = c[axis] - a[axis];
                w[axis] = at[axis] - a[axis];
            }
            CHECK(fabs(w[0] * (u[1] * v[2] - u[2] * v[1]) + w[1] * (u[2] * v[0] - u[0] * v[2]) +
                       w[2] * (u[0] * v[1] - u[1] * v[0])) < 1e-12);
            CHECK((point.third == DELOTET_INVALID_INDEX) == (point.ends[0] == DELOTET_INVALID_INDEX));
            CHECK((point.third == DELOTET_INVALID_INDEX) == (point.ends[1] == DELOTET_INVALID_INDEX));
            if (point.third == DELOTET_INVALID_INDEX) { /* The doubles are the place. */
                CHECK(point.exact && point.t == 0 && point.u == 0);
                continue;
            }
            plane_given++;
            CHECK(point.third < 8 && point.ends[0] < 8 && point.ends[1] < 8);
            a = xyz + 3 * point.ends[0];
            b = xyz + 3 * point.ends[1];
            c = xyz + 3 * point.third;
            for (axis = 0; axis < 3; axis++)
                CHECK(fabs(a[axis] + point.t * (b[axis] - a[axis]) + point.u * (c[axis] - a[axis]) - at[axis]) < 1e-12);
        } else {
            CHECK(point.third == DELOTET_INVALID_INDEX && point.u == 0);
            if (point.ends[0] == DELOTET_INVALID_INDEX) {
                inside++;
                CHECK(point.ends[1] == DELOTET_INVALID_INDEX && point.exact && point.t == 0);
                continue;
            }
            on_edges++;
            CHECK(point.ends[0] < 8 && point.ends[1] < 8 && point.t > 0 && point.t < 1);
            for (axis = 0; axis < 3; axis++) {
                double a = xyz[3 * point.ends[0] + axis], b = xyz[3 * point.ends[1] + axis];
                CHECK(fabs(a + point.t * (b - a) - at[axis]) < 1e-12);
            }
        }
    }
    printf("%zu on facets (%zu by three points), %zu on edges, %zu inside\n", on_facets, plane_given, on_edges, inside);
    CHECK(on_facets > plane_given && plane_given > 0 && on_edges > 0 && inside > 0);
    delotet_mesh_free(mesh);
    delotet_plc_free(plc);
    delotet_options_free(options);
}

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
        CHECK(point.segment == DELOTET_INVALID_INDEX && point.facet == DELOTET_INVALID_INDEX);
        CHECK(point.third == DELOTET_INVALID_INDEX && point.u == 0);
        for (axis = 0; axis < 3; axis++) {
            double a = xyz[3 * point.ends[0] + axis], b = xyz[3 * point.ends[1] + axis];
            CHECK(fabs(a + point.t * (b - a) - xyz[3 * (6 + i) + axis]) < 1e-12);
        }
    }
    CHECK(delotet_mesh_steiner_points(NULL).first == NULL);
    delotet_mesh_free(mesh);
    refined();
    return 0;
}
