/* delotet_options_set_mode: Delaunay alone ignores the facets, preserve keeps them as they are; unknown modes are refused. */
#include "test.h"

/* Schoenhardt's polyhedron: eight triangles that are all kept, one point inside. */
static void keeps_the_surface(const DelotetOptions *options)
{
    DelotetPlc *plc = twisted_prism();
    DelotetMesh *mesh = mesh_with(plc, options);
    DelotetSteinerView added = delotet_mesh_steiner_points(mesh);
    DelotetSubfacesView surface = delotet_mesh_subfaces(mesh);
    DelotetMesh *split = mesh_with(plc, NULL);
    size_t i, k;
    OK(delotet_mesh_check_preserved(mesh, plc, 10, &error));
    CHECK(delotet_mesh_points(mesh).count == 7 && delotet_mesh_input_point_count(mesh) == 6);
    CHECK(memcmp(delotet_mesh_points(mesh).data, delotet_plc_points(plc).data, 18 * sizeof(double)) == 0);
    CHECK(added.count == 1 && added.data[0].ends[0] == DELOTET_INVALID_INDEX && added.data[0].exact);
    CHECK(added.data[0].ends[1] == DELOTET_INVALID_INDEX && added.data[0].segment == DELOTET_INVALID_INDEX);
    CHECK(!(added.data[0].t > 0) && !(added.data[0].t < 0));
    CHECK(surface.count == 8);
    for (i = 0; i < surface.count; i++)
        for (k = 0; k < 3; k++)
            CHECK(surface.data[i].corners[k] < 6);
    for (i = 0; i < delotet_mesh_subsegments(mesh).count; i++)
        CHECK(delotet_mesh_subsegments(mesh).data[i].ends[0] < 6 && delotet_mesh_subsegments(mesh).data[i].ends[1] < 6);
    CHECK(near(volume(mesh), volume(split)));
    delotet_mesh_free(mesh);
    delotet_mesh_free(split);
    delotet_plc_free(plc);
}

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = nested_boxes();
    DelotetMesh *mesh;
    CHECK(delotet_options_set_mode(options, 3) == INVALID);
    CHECK(delotet_options_set_mode(options, UINT32_MAX) == INVALID);
    CHECK(delotet_options_set_mode(NULL, DELOTET_MODE_DELAUNAY) == INVALID);
    CHECK(delotet_options_set_mode(options, DELOTET_MODE_DELAUNAY) == DELOTET_STATUS_OK);
    mesh = mesh_with(plc, options);
    CHECK(delotet_mesh_subfaces(mesh).count == 0);
    CHECK(delotet_mesh_points(mesh).count == 16);
    CHECK(near(volume(mesh), 27));
    delotet_mesh_free(mesh);
    CHECK(delotet_options_set_mode(options, DELOTET_MODE_CONSTRAINED) == DELOTET_STATUS_OK);
    mesh = mesh_with(plc, options);
    CHECK(delotet_mesh_subfaces(mesh).count >= 24);
    delotet_mesh_free(mesh);
    CHECK(delotet_options_set_mode(options, DELOTET_MODE_PRESERVE) == DELOTET_STATUS_OK);
    mesh = mesh_with(plc, options);
    CHECK(delotet_mesh_subfaces(mesh).count == 24 && delotet_mesh_regions(mesh).count == 2);
    CHECK(near(volume(mesh), 27));
    OK(delotet_mesh_check_preserved(mesh, plc, 10, &error));
    delotet_mesh_free(mesh);
    keeps_the_surface(options);
    delotet_plc_free(plc);
    delotet_options_free(options);
    return 0;
}
