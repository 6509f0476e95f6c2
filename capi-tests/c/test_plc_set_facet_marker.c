/* delotet_plc_set_facet_marker: one facet, triangle or other; the mesh has it. */
#include "test.h"

int main(void)
{
    static const uint32_t square[4] = {4, 5, 7, 6};
    static const size_t end[1] = {4};
    double xyz[24];
    DelotetPlc *plc = NULL;
    DelotetMesh *mesh;
    DelotetSubfacesView faces;
    size_t i, seen = 0;
    box_points(xyz, 0, 1);
    OK(delotet_plc_new(xyz, 8, &plc, &error));
    OK(delotet_plc_add_triangles(plc, BOX, NULL, 2, &error));
    OK(delotet_plc_add_triangles(plc, BOX + 12, NULL, 8, &error));
    OK(delotet_plc_add_polygons(plc, square, end, NULL, 1, &error));
    OK(delotet_plc_set_facet_marker(plc, 3, 33, &error));
    OK(delotet_plc_set_facet_marker(plc, 10, -44, &error));
    CHECK(delotet_plc_facet_marker(plc, 3) == 33 && delotet_plc_facet_marker(plc, 10) == -44);
    CHECK(delotet_plc_facet_marker(plc, 2) == 0 && delotet_plc_facet_marker(plc, 9) == 0);
    mesh = mesh_with(plc, NULL);
    faces = delotet_mesh_subfaces(mesh);
    for (i = 0; i < faces.count; i++)
        seen += DELOTET_AT(DelotetSubface, faces, i)->marker == -44;
    CHECK(seen == 2);
    delotet_mesh_free(mesh);
    FAILS(DELOTET_STATUS_INDEX_OUT_OF_RANGE, delotet_plc_set_facet_marker(plc, 11, 1, &error));
    FAILS(INVALID, delotet_plc_set_facet_marker(NULL, 0, 1, &error));
    delotet_plc_free(plc);
    return 0;
}
