/* delotet_mesh_point_aliases: equal points are mapped to the first. */
#include "test.h"

int main(void)
{
    double xyz[27];
    DelotetPlc *plc = NULL;
    DelotetMesh *mesh;
    DelotetIndicesView aliases;
    uint32_t i;
    box_points(xyz, 0, 1);
    xyz[24] = 1, xyz[25] = 0, xyz[26] = 1; /* Corner 5 again. */
    OK(delotet_plc_new(xyz, 9, &plc, &error));
    OK(delotet_plc_add_triangles(plc, BOX, NULL, 12, &error));
    mesh = mesh_of(plc);
    aliases = delotet_mesh_point_aliases(mesh);
    CHECK(aliases.count == 9);
    for (i = 0; i < 8; i++)
        CHECK(aliases.data[i] == i);
    CHECK(aliases.data[8] == 5);
    CHECK(delotet_mesh_point_aliases(NULL).data == NULL);
    delotet_mesh_free(mesh);
    return 0;
}
