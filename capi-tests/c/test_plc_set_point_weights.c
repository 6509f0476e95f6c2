/* delotet_plc_set_point_weights: one each or none, finite; heavy points hide others; not with facets, segments or other modes. */
#include "voronoi.h"

int main(void)
{
    enum { COUNT = SIDE * SIDE * SIDE };
    double weights[COUNT + 1] = {0};
    DelotetPlc *plc = grid_points();
    DelotetOptions *options = delotet_options_new();
    DelotetMesh *mesh = delaunay_of(plc), *none = NULL;
    size_t tets = delotet_mesh_tets(mesh).count;
    uint32_t first;
    delotet_mesh_free(mesh);
    weights[21] = 3.5;
    OK(delotet_plc_set_point_weights(plc, weights, COUNT, &error));
    mesh = delaunay_of(plc);
    /* The cell of point 21 swallows those of its inner neighbours; those on the hull are unbounded. */
    CHECK(delotet_mesh_hidden_points(mesh).count == 3 && delotet_mesh_tets(mesh).count < tets);
    CHECK(near(volume(mesh), 27));
    delotet_mesh_free(mesh);

    FAILS(INVALID, delotet_tetrahedralize(plc, NULL, &none, &error));
    OK(delotet_options_set_mode(options, DELOTET_MODE_DELAUNAY, &error));
    OK(delotet_plc_add_segment(plc, 0, 1, 0, &error));
    FAILS(INVALID, delotet_tetrahedralize(plc, options, &none, &error));
    FAILS(INVALID, delotet_plc_check(plc, options, &error));
    CHECK(none == NULL);
    delotet_plc_free(plc);

    plc = grid_points();
    weights[5] = NAN;
    FAILS(INVALID, delotet_plc_set_point_weights(plc, weights, COUNT, &error));
    weights[5] = -INFINITY;
    FAILS(INVALID, delotet_plc_set_point_weights(plc, weights, COUNT, &error));
    weights[5] = -2;
    FAILS(INVALID, delotet_plc_set_point_weights(plc, weights, COUNT - 1, &error));
    FAILS(INVALID, delotet_plc_set_point_weights(plc, weights, COUNT + 1, &error));
    FAILS(INVALID, delotet_plc_set_point_weights(plc, NULL, COUNT, &error));
    FAILS(INVALID, delotet_plc_set_point_weights(NULL, weights, COUNT, &error));
    CHECK(delotet_plc_point_weights(plc).count == 0);
    weights[5] = 1e300;
    OK(delotet_plc_set_point_weights(plc, weights, COUNT, &error));
    FAILS(DELOTET_STATUS_COORDINATE_RANGE, delotet_tetrahedralize(plc, options, &none, &error));
    weights[5] = 0;
    OK(delotet_plc_set_point_weights(plc, weights, COUNT, &error));
    /* A point that is added has the weight 0. */
    weights[0] = weights[1] = weights[2] = 0.5;
    OK(delotet_plc_add_points(plc, weights, 1, &first, &error));
    CHECK(delotet_plc_point_weights(plc).count == COUNT + 1 && delotet_plc_point_weights(plc).data[first] == 0);
    mesh = delaunay_of(plc);
    CHECK(delotet_mesh_points(mesh).count == COUNT + 1);
    delotet_mesh_free(mesh);
    OK(delotet_plc_set_point_weights(plc, NULL, 0, &error));
    mesh = delaunay_of(plc);
    CHECK(delotet_mesh_hidden_points(mesh).count == 0);
    delotet_mesh_free(mesh);
    delotet_plc_free(plc);
    delotet_options_free(options);
    return 0;
}
