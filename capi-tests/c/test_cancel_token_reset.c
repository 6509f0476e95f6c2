/* delotet_cancel_token_reset: runs succeed again. */
#include "test.h"

int main(void)
{
    DelotetCancelToken *token = delotet_cancel_token_new();
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = cube();
    DelotetMesh *mesh;
    OK(delotet_options_set_cancel_token(options, token, &error));
    delotet_cancel_token_cancel(token);
    FAILS(DELOTET_STATUS_CANCELLED, delotet_tetrahedralize(plc, options, &mesh, &error));
    delotet_cancel_token_reset(token);
    delotet_mesh_free(mesh_with(plc, options));
    delotet_cancel_token_reset(NULL);
    delotet_cancel_token_free(token);
    delotet_plc_free(plc);
    delotet_options_free(options);
    return 0;
}
