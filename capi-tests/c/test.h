/* What the tests of the C functions share: checks that end the program, and small inputs. */
#ifndef DELOTET_TEST_H
#define DELOTET_TEST_H
#include <delotet/delotet.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CHECK(condition)                                                             \
    do {                                                                             \
        if (!(condition)) {                                                          \
            fprintf(stderr, "%s:%d: failed: %s\n", __FILE__, __LINE__, #condition);  \
            exit(1);                                                                 \
        }                                                                            \
    } while (0)

/* The call must succeed; it uses the variable `error`, which must be NULL afterwards. */
#define OK(call)                                                                     \
    do {                                                                             \
        DelotetError *error = NULL;                                                  \
        DelotetStatus status_ = (call);                                              \
        if (status_ != DELOTET_STATUS_OK || error) {                                 \
            fprintf(stderr, "%s:%d: %s: %s\n", __FILE__, __LINE__,                   \
                    delotet_status_name((uint32_t)status_), delotet_error_message(error)); \
            exit(1);                                                                 \
        }                                                                            \
    } while (0)

/* The call must fail with this status and leave an error that says the same; a caller without error object gets it too. */
#define FAILS(expected, call)                                                        \
    do {                                                                             \
        DelotetError *error = NULL;                                                  \
        DelotetStatus status_ = (call);                                              \
        if (status_ != (expected)) {                                                 \
            fprintf(stderr, "%s:%d: %s instead of %s: %s\n", __FILE__, __LINE__,     \
                    delotet_status_name((uint32_t)status_), #expected, delotet_error_message(error)); \
            exit(1);                                                                 \
        }                                                                            \
        CHECK(error != NULL);                                                        \
        CHECK(delotet_error_status(error) == (expected));                            \
        CHECK(delotet_error_message(error)[0] != '\0');                              \
        delotet_error_free(error);                                                   \
    } while (0)

#define INVALID DELOTET_STATUS_INVALID_ARGUMENT

/* A box from `low` to `high`: eight points, corner i has x high if bit 0 of i is set, y for bit 1, z for bit 2. */
static inline void box_points(double *xyz, double low, double high)
{
    int i;
    for (i = 0; i < 8; i++) {
        xyz[3 * i] = i & 1 ? high : low;
        xyz[3 * i + 1] = i & 2 ? high : low;
        xyz[3 * i + 2] = i & 4 ? high : low;
    }
}

/* Twelve triangles of a box, looking outward; triangle i lies on side i / 2. */
static const uint32_t BOX[36] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
/* Side i / 2, plus 1. */
static const int32_t BOX_MARKERS[12] = {1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6};

/* The unit cube with markers 1 to 6 on its sides. */
static inline DelotetPlc *cube(void)
{
    double xyz[24];
    DelotetPlc *plc = NULL;
    box_points(xyz, 0, 1);
    OK(delotet_plc_new(xyz, 8, &plc, &error));
    OK(delotet_plc_add_triangles(plc, BOX, BOX_MARKERS, 12, &error));
    return plc;
}

/* A box from 0 to GRID whose sides are cut into unit squares of two triangles each, so that there is room inside; sides have markers 1 to 6. */
#define GRID 6
static inline DelotetPlc *grid_box(void)
{
    enum { LINE = GRID + 1, POINTS = 6 * GRID * GRID + 2 };
    static const int step[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
    double xyz[3 * POINTS] = {0};
    uint32_t index[LINE][LINE][LINE] = {{{0}}}, count = 0, corners[3] = {0};
    DelotetPlc *plc = NULL;
    int at[3], side, i, j, k;
    for (at[0] = 0; at[0] < LINE; at[0]++)
        for (at[1] = 0; at[1] < LINE; at[1]++)
            for (at[2] = 0; at[2] < LINE; at[2]++) {
                int inside = 1;
                for (i = 0; i < 3; i++)
                    inside &= at[i] > 0 && at[i] < GRID;
                if (inside)
                    continue;
                for (i = 0; i < 3; i++)
                    xyz[3 * count + (uint32_t)i] = at[i];
                index[at[0]][at[1]][at[2]] = count++;
            }
    CHECK(count == POINTS);
    OK(delotet_plc_new(xyz, count, &plc, &error));
    for (side = 0; side < 6; side++)
        for (i = 0; i < GRID; i++)
            for (j = 0; j < GRID; j++)
                for (k = 0; k < 6; k++) {
                    const int32_t marker = side + 1;
                    at[side / 2] = side % 2 * GRID;
                    at[(side / 2 + 1) % 3] = i + step[k][0];
                    at[(side / 2 + 2) % 3] = j + step[k][1];
                    corners[k % 3] = index[at[0]][at[1]][at[2]];
                    if (k % 3 == 2)
                        OK(delotet_plc_add_triangles(plc, corners, &marker, 1, &error));
                }
    return plc;
}

/* A box from 0 to 3 around a box from 1 to 2; the outer one has marker 7, the inner one 8. */
static inline DelotetPlc *nested_boxes(void)
{
    double xyz[48];
    uint32_t inner[36];
    int32_t markers[12];
    DelotetPlc *plc = NULL;
    int i;
    box_points(xyz, 0, 3);
    box_points(xyz + 24, 1, 2);
    OK(delotet_plc_new(xyz, 16, &plc, &error));
    for (i = 0; i < 36; i++)
        inner[i] = BOX[i] + 8;
    for (i = 0; i < 12; i++)
        markers[i] = 7;
    OK(delotet_plc_add_triangles(plc, BOX, markers, 12, &error));
    for (i = 0; i < 12; i++)
        markers[i] = 8;
    OK(delotet_plc_add_triangles(plc, inner, markers, 12, &error));
    return plc;
}

/* Schoenhardt's polyhedron: a twisted prism that has no tetrahedralization without Steiner points. */
static inline DelotetPlc *twisted_prism(void)
{
    static const double xyz[18] = {0, 0, 0, 4, 0, 0, 2, 3, 0, 1, -1, 4, 4, 1.5, 4, 0.5, 2.5, 4};
    static const uint32_t corners[24] = {0, 2, 1, 3, 4, 5, 0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 2, 0, 3, 2, 3, 5};
    DelotetPlc *plc = NULL;
    OK(delotet_plc_new(xyz, 6, &plc, &error));
    OK(delotet_plc_add_triangles(plc, corners, NULL, 8, &error));
    return plc;
}

/* A prism over a triangle with an angle of 10 degrees at points 0 and 3: facets 2 and 3 meet facets 6 and 7 there. */
static inline DelotetPlc *narrow_wedge(void)
{
    static const uint32_t corners[24] = {0, 2, 1, 3, 4, 5, 0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 2, 0, 3, 2, 3, 5};
    const double angle = 10 * acos(-1.0) / 180;
    double xyz[18] = {0};
    DelotetPlc *plc = NULL;
    xyz[3] = xyz[12] = 1;
    xyz[6] = xyz[15] = cos(angle);
    xyz[7] = xyz[16] = sin(angle);
    xyz[11] = xyz[14] = xyz[17] = 1;
    OK(delotet_plc_new(xyz, 6, &plc, &error));
    OK(delotet_plc_add_triangles(plc, corners, NULL, 8, &error));
    return plc;
}

/* The unit cube with a triangle inside, facet 12, that has an angle of 10 degrees at point 8. */
static inline DelotetPlc *cube_with_blade(void)
{
    static const uint32_t blade[3] = {8, 9, 10};
    const double angle = 10 * acos(-1.0) / 180;
    double xyz[33] = {0};
    DelotetPlc *plc = NULL;
    box_points(xyz, 0, 1);
    xyz[24] = xyz[25] = xyz[28] = 0.2;
    xyz[27] = 0.8;
    xyz[30] = 0.2 + 0.6 * cos(angle);
    xyz[31] = 0.2 + 0.6 * sin(angle);
    xyz[26] = xyz[29] = xyz[32] = 0.5;
    OK(delotet_plc_new(xyz, 11, &plc, &error));
    OK(delotet_plc_add_triangles(plc, BOX, BOX_MARKERS, 12, &error));
    OK(delotet_plc_add_triangles(plc, blade, NULL, 1, &error));
    return plc;
}

/* A tetrahedron and a triangle that pierces it. */
static inline DelotetPlc *pierced(void)
{
    static const double xyz[21] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4, 1, 1, -1, 1.5, 1, -1, 1, 1, 0.75};
    static const uint32_t corners[15] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3, 4, 5, 6};
    DelotetPlc *plc = NULL;
    OK(delotet_plc_new(xyz, 7, &plc, &error));
    OK(delotet_plc_add_triangles(plc, corners, NULL, 5, &error));
    return plc;
}

/* A cube, a loose segment beside it and a triangle on its edge, outward: neither is meshed. */
static inline DelotetPlc *cube_with_fin(void)
{
    static const uint32_t fin[3] = {1, 3, 8};
    static const int32_t marker = 9;
    double xyz[33] = {0};
    DelotetPlc *plc = NULL;
    box_points(xyz, 0, 1);
    xyz[24] = 2;
    xyz[27] = 5;
    xyz[30] = 6;
    OK(delotet_plc_new(xyz, 11, &plc, &error));
    OK(delotet_plc_add_triangles(plc, BOX, BOX_MARKERS, 12, &error));
    OK(delotet_plc_add_triangles(plc, fin, &marker, 1, &error));
    OK(delotet_plc_add_segment(plc, 9, 10, 4, &error));
    return plc;
}

/* Points in the unit cube, the same in every run. */
static inline DelotetPlc *cloud(size_t count)
{
    double *xyz = (double *)malloc(count * 3 * sizeof *xyz);
    uint64_t state = 1;
    DelotetPlc *plc = NULL;
    size_t i;
    CHECK(xyz != NULL);
    for (i = 0; i < 3 * count; i++) {
        state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
        xyz[i] = (double)(state >> 11) / 9007199254740992.0;
    }
    OK(delotet_plc_new(xyz, count, &plc, &error));
    free(xyz);
    return plc;
}

static inline DelotetMesh *mesh_with(const DelotetPlc *plc, const DelotetOptions *options)
{
    DelotetMesh *mesh = NULL;
    OK(delotet_tetrahedralize(plc, options, &mesh, &error));
    CHECK(mesh != NULL);
    return mesh;
}

/* The mesh of a PLC, which is freed. */
static inline DelotetMesh *mesh_of(DelotetPlc *plc)
{
    DelotetMesh *mesh = mesh_with(plc, NULL);
    delotet_plc_free(plc);
    return mesh;
}

static inline double volume_of(const double *xyz, const uint32_t *tet)
{
    const double *a = xyz + 3 * tet[0], *b = xyz + 3 * tet[1], *c = xyz + 3 * tet[2], *d = xyz + 3 * tet[3];
    double u[3], v[3], w[3];
    int i;
    for (i = 0; i < 3; i++) {
        u[i] = b[i] - a[i];
        v[i] = c[i] - a[i];
        w[i] = d[i] - a[i];
    }
    return (u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) +
            u[2] * (v[0] * w[1] - v[1] * w[0])) / 6;
}

/* Sum of the volumes; every tetrahedron must be positive. */
static inline double volume(const DelotetMesh *mesh)
{
    DelotetPointsView points = delotet_mesh_points(mesh);
    DelotetTetsView tets = delotet_mesh_tets(mesh);
    double sum = 0;
    size_t i;
    for (i = 0; i < tets.count; i++) {
        CHECK(volume_of(points.data, tets.data + 4 * i) > 0);
        sum += volume_of(points.data, tets.data + 4 * i);
    }
    return sum;
}

/* The number of points of the mesh of a grid_box() in DELOTET_MODE_PRESERVE, whose surface must be kept. */
static inline size_t points_in_grid(const DelotetPlc *plc, const DelotetOptions *options)
{
    DelotetMesh *mesh = mesh_with(plc, options);
    size_t count = delotet_mesh_points(mesh).count;
    OK(delotet_mesh_check_preserved(mesh, plc, 10, &error));
    CHECK(fabs(volume(mesh) - GRID * GRID * GRID) < 1e-9);
    delotet_mesh_free(mesh);
    return count;
}

static inline int near(double a, double b)
{
    return fabs(a - b) <= 1e-12 * (fabs(a) + fabs(b));
}

/* The number of points of a mesh after refining it with these sizes. */
static inline size_t points_refined(const DelotetMesh *mesh, const DelotetMeshSizes *sizes)
{
    DelotetMesh *fine = NULL;
    size_t count;
    OK(delotet_mesh_refine(mesh, sizes, NULL, &fine, &error));
    count = delotet_mesh_points(fine).count;
    CHECK(near(volume(fine), volume(mesh)));
    delotet_mesh_free(fine);
    return count;
}
#endif
