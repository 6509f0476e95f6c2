/* delotet_mesh_point_attributes: the input's, and linear at Steiner points, on edges and inside. */
#include "test.h"

int main(void)
{
    DelotetPlc *plc = twisted_prism();
    DelotetOptions *options = delotet_options_new();
    DelotetMesh *mesh;
    DelotetDoublesView fields;
    DelotetPointsView points;
    size_t i;
    /* The coordinates as attributes: linear interpolation gives the coordinates of the Steiner points. */
    OK(delotet_plc_set_point_attributes(plc, delotet_plc_points(plc).data, 3, &error));
    mesh = mesh_of(plc);
    fields = delotet_mesh_point_attributes(mesh);
    points = delotet_mesh_points(mesh);
    CHECK(fields.width == 3 && fields.count == points.count && points.count > 6);
    for (i = 0; i < 3 * points.count; i++)
        CHECK(fabs(fields.data[i] - points.data[i]) < 1e-12);
    CHECK(delotet_mesh_point_attributes(NULL).data == NULL);
    delotet_mesh_free(mesh);
    /* A point inside: in a tetrahedron of points around it. */
    plc = twisted_prism();
    OK(delotet_plc_set_point_attributes(plc, delotet_plc_points(plc).data, 3, &error));
    OK(delotet_options_set_mode(options, DELOTET_MODE_PRESERVE, &error));
    mesh = mesh_with(plc, options);
    fields = delotet_mesh_point_attributes(mesh);
    points = delotet_mesh_points(mesh);
    CHECK(fields.count == points.count && points.count > 6);
    for (i = 0; i < 3 * points.count; i++)
        CHECK(fabs(fields.data[i] - points.data[i]) < 1e-12);
    delotet_mesh_free(mesh);
    delotet_plc_free(plc);
    delotet_options_free(options);
    mesh = mesh_of(cube());
    CHECK(delotet_mesh_point_attributes(mesh).data == NULL);
    delotet_mesh_free(mesh);
    return 0;
}
