/* delotet_write_options_set_cancel_token: a cancelled call leaves no file behind. */
#include "test.h"

int main(void)
{
    DelotetWriteOptions *options = delotet_write_options_new();
    DelotetCancelToken *token = delotet_cancel_token_new();
    DelotetPlc *plc = cube();
    DelotetMesh *mesh = mesh_with(plc, NULL);
    OK(delotet_write_options_set_cancel_token(options, token, &error));
    delotet_cancel_token_cancel(token);
    FAILS(DELOTET_STATUS_CANCELLED, delotet_mesh_write_with(mesh, plc, "write_cancel.vtu", options, &error));
    FAILS(DELOTET_STATUS_CANCELLED, delotet_plc_write_with(plc, "write_cancel.off", options, &error));
    CHECK(fopen("write_cancel.vtu", "r") == NULL && fopen("write_cancel.off", "r") == NULL);
    delotet_cancel_token_reset(token);
    OK(delotet_mesh_write_with(mesh, plc, "write_cancel.vtu", options, &error));
    OK(delotet_plc_write_with(plc, "write_cancel.off", options, &error));
    CHECK(remove("write_cancel.vtu") == 0 && remove("write_cancel.off") == 0);
    FAILS(INVALID, delotet_write_options_set_cancel_token(NULL, token, &error));
    delotet_cancel_token_free(token);
    delotet_mesh_free(mesh);
    delotet_plc_free(plc);
    delotet_write_options_free(options);
    return 0;
}
