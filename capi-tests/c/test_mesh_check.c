/* delotet_mesh_check: a mesh passes against its PLC and fails against another. */
#include "test.h"

/* A mesh that has no subfaces at all covers no facet, but of mode delaunay facets are not asked for. */
static void no_subfaces(void)
{
    static const double xyz[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    static const uint32_t corners[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = NULL;
    DelotetMesh *hull, *delaunay;
    OK(delotet_plc_new(xyz, 4, &plc, &error));
    OK(delotet_options_set_keep_hull(options, true, &error));
    hull = mesh_with(plc, options);
    OK(delotet_mesh_check(hull, plc, true, 10, &error));
    OK(delotet_plc_add_triangles(plc, corners, NULL, 4, &error));
    CHECK(delotet_mesh_subfaces(hull).count == 0);
    FAILS(DELOTET_STATUS_CHECK_FAILED, delotet_mesh_check(hull, plc, true, 10, &error));
    FAILS(DELOTET_STATUS_CHECK_FAILED, delotet_mesh_check(hull, plc, false, 10, &error));
    OK(delotet_options_set_mode(options, DELOTET_MODE_DELAUNAY, &error));
    delaunay = mesh_with(plc, options);
    OK(delotet_mesh_check(delaunay, plc, true, 10, &error));
    FAILS(DELOTET_STATUS_CHECK_FAILED, delotet_mesh_check_preserved(delaunay, plc, 10, &error));
    FAILS(DELOTET_STATUS_CHECK_FAILED, delotet_mesh_check_preserved_outer(delaunay, plc, 10, &error));
    delotet_mesh_free(hull);
    delotet_mesh_free(delaunay);
    delotet_plc_free(plc);
    delotet_options_free(options);
}

int main(void)
{
    DelotetPlc *plc = nested_boxes(), *other = cube();
    DelotetMesh *mesh = mesh_with(plc, NULL);
    DelotetError *error = NULL;
    OK(delotet_mesh_check(mesh, plc, true, 10, &error));
    OK(delotet_mesh_check(mesh, plc, false, 10, &error));
    CHECK(delotet_mesh_check(mesh, other, true, 3, &error) == DELOTET_STATUS_CHECK_FAILED);
    CHECK(delotet_error_defects(error).count >= 1 && delotet_error_defects(error).count <= 3);
    delotet_error_free(error);
    FAILS(INVALID, delotet_mesh_check(NULL, plc, true, 3, &error));
    FAILS(INVALID, delotet_mesh_check(mesh, NULL, true, 3, &error));
    delotet_mesh_free(mesh);
    delotet_plc_free(plc);
    delotet_plc_free(other);
    no_subfaces();
    return 0;
}
