/* delotet_options_set_time_limit: a run that takes longer ends; values that are no times are refused. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = cloud(300000), *small = cube();
    DelotetMesh *mesh;
    DelotetError *failure = NULL;
    OK(delotet_options_set_mode(options, DELOTET_MODE_DELAUNAY, &error));
    OK(delotet_options_set_time_limit(options, 0.001, &error));
    CHECK(delotet_tetrahedralize(plc, options, &mesh, &failure) == DELOTET_STATUS_TIME_LIMIT);
    CHECK(mesh == NULL && strstr(delotet_error_message(failure), "0.001 s") != NULL);
    delotet_error_free(failure);
    /* It counts anew for each run. */
    OK(delotet_options_set_time_limit(options, 1e9, &error));
    delotet_mesh_free(mesh_with(small, options));
    delotet_mesh_free(mesh_with(small, options));
    FAILS(INVALID, delotet_options_set_time_limit(options, -1, &error));
    FAILS(INVALID, delotet_options_set_time_limit(options, NAN, &error));
    FAILS(INVALID, delotet_options_set_time_limit(options, INFINITY, &error));
    CHECK(near(delotet_options_time_limit(options), 1e9));
    OK(delotet_options_set_time_limit(options, 1e300, &error));
    delotet_mesh_free(mesh_with(small, options));
    OK(delotet_options_set_time_limit(options, 0, &error));
    delotet_mesh_free(mesh_with(small, options));
    FAILS(INVALID, delotet_options_set_time_limit(NULL, 1, &error));
    delotet_plc_free(plc);
    delotet_plc_free(small);
    delotet_options_free(options);
    return 0;
}
