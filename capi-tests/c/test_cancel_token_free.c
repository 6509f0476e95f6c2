/* delotet_cancel_token_free: options keep a token alive; NULL is ignored. */
#include "test.h"

int main(void)
{
    DelotetCancelToken *token = delotet_cancel_token_new();
    DelotetOptions *options = delotet_options_new(), *others = delotet_options_new();
    DelotetPlc *plc = cube();
    DelotetMesh *mesh;
    OK(delotet_options_set_cancel_token(options, token, &error));
    OK(delotet_options_set_cancel_token(others, token, &error));
    delotet_cancel_token_cancel(token);
    delotet_cancel_token_free(token);
    FAILS(DELOTET_STATUS_CANCELLED, delotet_tetrahedralize(plc, options, &mesh, &error));
    delotet_options_free(options);
    FAILS(DELOTET_STATUS_CANCELLED, delotet_tetrahedralize(plc, others, &mesh, &error));
    /* Their part ends here, and the token with it. */
    OK(delotet_options_set_cancel_token(others, NULL, &error));
    delotet_mesh_free(mesh_with(plc, others));
    delotet_cancel_token_free(NULL);
    delotet_plc_free(plc);
    delotet_options_free(others);
    return 0;
}
