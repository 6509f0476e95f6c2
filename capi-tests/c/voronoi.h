/* What the tests of weights and Voronoi diagrams share. */
#ifndef DELOTET_VORONOI_TEST_H
#define DELOTET_VORONOI_TEST_H
#include "test.h"

/* Points per axis of grid_points(). */
#define SIDE 4

/* The points of an integer grid, x fastest. */
static inline DelotetPlc *grid_points(void)
{
    double xyz[3 * SIDE * SIDE * SIDE];
    DelotetPlc *plc = NULL;
    int i;
    for (i = 0; i < SIDE * SIDE * SIDE; i++) {
        xyz[3 * i] = i % SIDE;
        xyz[3 * i + 1] = i / SIDE % SIDE;
        xyz[3 * i + 2] = i / SIDE / SIDE;
    }
    OK(delotet_plc_new(xyz, SIDE * SIDE * SIDE, &plc, &error));
    return plc;
}

/* A point of the grid that is on none of its sides. */
static inline int is_inner(size_t i)
{
    size_t x = i % SIDE, y = i / SIDE % SIDE, z = i / SIDE / SIDE;
    return x > 0 && x < SIDE - 1 && y > 0 && y < SIDE - 1 && z > 0 && z < SIDE - 1;
}

/* The mesh of a PLC in DELOTET_MODE_DELAUNAY. */
static inline DelotetMesh *delaunay_of(const DelotetPlc *plc)
{
    DelotetOptions *options = delotet_options_new();
    DelotetMesh *mesh;
    OK(delotet_options_set_mode(options, DELOTET_MODE_DELAUNAY, &error));
    mesh = mesh_with(plc, options);
    delotet_options_free(options);
    OK(delotet_mesh_check(mesh, plc, true, 10, &error));
    return mesh;
}

static inline DelotetVoronoi *voronoi_of(const DelotetMesh *mesh)
{
    DelotetVoronoi *voronoi = NULL;
    OK(delotet_voronoi_new(mesh, NULL, &voronoi, &error));
    CHECK(voronoi != NULL);
    return voronoi;
}

/* The diagram of the grid; the mesh and the PLC are freed. */
static inline DelotetVoronoi *voronoi_of_grid(void)
{
    DelotetPlc *plc = grid_points();
    DelotetMesh *mesh = delaunay_of(plc);
    DelotetVoronoi *voronoi = voronoi_of(mesh);
    delotet_mesh_free(mesh);
    delotet_plc_free(plc);
    return voronoi;
}
#endif
