/* delotet_options_set_mode: Delaunay alone ignores the facets, preserve keeps them as they are; unknown modes are refused. */
#include "test.h"

/* Schoenhardt's polyhedron: eight triangles that are all kept, one point inside. */
static void keeps_the_surface(const DelotetOptions *options)
{
    DelotetPlc *plc = twisted_prism();
    DelotetMesh *mesh = mesh_with(plc, options);
    DelotetSteinerView added = delotet_mesh_steiner_points(mesh);
    DelotetSubfacesView surface = delotet_mesh_subfaces(mesh);
    DelotetSubsegmentsView edges = delotet_mesh_subsegments(mesh);
    DelotetMesh *split = mesh_with(plc, NULL);
    const DelotetSteinerPoint *point;
    size_t i, k;
    OK(delotet_mesh_check_preserved(mesh, plc, 10, &error));
    CHECK(delotet_mesh_points(mesh).count == 7 && delotet_mesh_input_point_count(mesh) == 6);
    CHECK(memcmp(delotet_mesh_points(mesh).data, delotet_plc_points(plc).data, 18 * sizeof(double)) == 0);
    CHECK(added.count == 1);
    point = DELOTET_AT(DelotetSteinerPoint, added, 0);
    CHECK(point->ends[0] == DELOTET_INVALID_INDEX && point->exact);
    CHECK(point->ends[1] == DELOTET_INVALID_INDEX && point->segment == DELOTET_INVALID_INDEX);
    CHECK(!(point->t > 0) && !(point->t < 0));
    CHECK(surface.count == 8);
    for (i = 0; i < surface.count; i++)
        for (k = 0; k < 3; k++)
            CHECK(DELOTET_AT(DelotetSubface, surface, i)->corners[k] < 6);
    for (i = 0; i < edges.count; i++)
        for (k = 0; k < 2; k++)
            CHECK(DELOTET_AT(DelotetSubsegment, edges, i)->ends[k] < 6);
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
    FAILS(INVALID, delotet_options_set_mode(options, 3, &error));
    FAILS(INVALID, delotet_options_set_mode(options, UINT32_MAX, &error));
    FAILS(INVALID, delotet_options_set_mode(NULL, DELOTET_MODE_DELAUNAY, &error));
    OK(delotet_options_set_mode(options, DELOTET_MODE_DELAUNAY, &error));
    mesh = mesh_with(plc, options);
    CHECK(delotet_mesh_subfaces(mesh).count == 0);
    CHECK(delotet_mesh_points(mesh).count == 16);
    CHECK(near(volume(mesh), 27));
    delotet_mesh_free(mesh);
    OK(delotet_options_set_mode(options, DELOTET_MODE_CONSTRAINED, &error));
    mesh = mesh_with(plc, options);
    CHECK(delotet_mesh_subfaces(mesh).count >= 24);
    delotet_mesh_free(mesh);
    OK(delotet_options_set_mode(options, DELOTET_MODE_PRESERVE, &error));
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
