/* delotet_write_options_set_time_limit: a call that takes longer leaves no file behind; values that are no times are refused. */
#include "test.h"

int main(void)
{
    DelotetWriteOptions *options = delotet_write_options_new();
    DelotetPlc *plc = cube();
    DelotetMesh *mesh = mesh_with(plc, NULL);
    OK(delotet_write_options_set_time_limit(options, 1e-9, &error));
    FAILS(DELOTET_STATUS_TIME_LIMIT, delotet_mesh_write_with(mesh, plc, "write_time.msh", options, &error));
    CHECK(fopen("write_time.msh", "r") == NULL);
    OK(delotet_write_options_set_time_limit(options, 1e9, &error));
    OK(delotet_mesh_write_with(mesh, plc, "write_time.msh", options, &error));
    OK(delotet_write_options_set_time_limit(options, 0, &error));
    OK(delotet_mesh_write_with(mesh, plc, "write_time.msh", options, &error));
    CHECK(remove("write_time.msh") == 0);
    FAILS(INVALID, delotet_write_options_set_time_limit(options, -1, &error));
    FAILS(INVALID, delotet_write_options_set_time_limit(options, NAN, &error));
    FAILS(INVALID, delotet_write_options_set_time_limit(NULL, 1, &error));
    delotet_mesh_free(mesh);
    delotet_plc_free(plc);
    delotet_write_options_free(options);
    return 0;
}
