/* delotet_options_background: the sizes that were set; none at first. */
#include "test.h"

/* A tetrahedron around the grid, whose sizes grow along x. */
static DelotetMesh *around(void)
{
    static const double xyz[12] = {-10, -10, -10, 40, -10, -10, -10, 40, -10, -10, -10, 40};
    static const uint32_t tet[4] = {0, 1, 2, 3};
    DelotetMesh *mesh = NULL;
    OK(delotet_mesh_from_arrays(xyz, 4, 4, tet, 1, NULL, NULL, 0, NULL, NULL, 0, NULL, NULL, &mesh, &error));
    return mesh;
}

int main(void)
{
    static const double sizes[4] = {0.5, 2, 0.5, INFINITY};
    DelotetOptions *options = delotet_options_new();
    DelotetMesh *mesh = around();
    CHECK(delotet_options_background(options).count == 0 && delotet_options_background(NULL).count == 0);
    OK(delotet_options_set_background(options, mesh, sizes, 4, &error));
    delotet_mesh_free(mesh);
    CHECK(delotet_options_background(options).count == 4 && delotet_options_background(options).data[1] == 2);
    CHECK(isinf(delotet_options_background(options).data[3]));
    OK(delotet_options_set_background(options, NULL, NULL, 0, &error));
    CHECK(delotet_options_background(options).count == 0);
    delotet_options_free(options);
    return 0;
}
