/* delotet_options_set_steiner_limit: a limit of none stops a polyhedron that needs some. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = twisted_prism();
    DelotetMesh *mesh = NULL;
    CHECK(delotet_options_set_steiner_limit(options, 0) == DELOTET_STATUS_OK);
    FAILS(DELOTET_STATUS_STEINER_LIMIT, delotet_tetrahedralize(plc, options, &mesh, &error));
    CHECK(mesh == NULL);
    CHECK(delotet_options_set_steiner_limit(options, UINT64_MAX) == DELOTET_STATUS_OK);
    mesh = mesh_with(plc, options);
    CHECK(delotet_mesh_steiner_points(mesh).count > 0);
    delotet_mesh_free(mesh);
    CHECK(delotet_options_set_steiner_limit(NULL, 1) == INVALID);
    delotet_plc_free(plc);
    delotet_options_free(options);
    return 0;
}
