/* delotet_options_set_steiner_limit: a limit of none stops a polyhedron that needs some. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = twisted_prism();
    DelotetMesh *mesh = NULL;
    OK(delotet_options_set_steiner_limit(options, 0, &error));
    FAILS(DELOTET_STATUS_STEINER_LIMIT, delotet_tetrahedralize(plc, options, &mesh, &error));
    CHECK(mesh == NULL);
    OK(delotet_options_set_steiner_limit(options, UINT64_MAX, &error));
    mesh = mesh_with(plc, options);
    CHECK(delotet_mesh_steiner_points(mesh).count > 0);
    delotet_mesh_free(mesh);
    FAILS(INVALID, delotet_options_set_steiner_limit(NULL, 1, &error));
    delotet_plc_free(plc);
    delotet_options_free(options);
    return 0;
}
