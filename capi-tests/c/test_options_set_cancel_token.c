/* delotet_options_set_cancel_token: the token set last counts, NULL is none. */
#include "test.h"

int main(void)
{
    DelotetCancelToken *cancelled = delotet_cancel_token_new(), *fresh = delotet_cancel_token_new();
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = cube();
    DelotetMesh *mesh;
    delotet_cancel_token_cancel(cancelled);
    OK(delotet_options_set_cancel_token(options, cancelled, &error));
    FAILS(DELOTET_STATUS_CANCELLED, delotet_tetrahedralize(plc, options, &mesh, &error));
    CHECK(mesh == NULL);
    OK(delotet_options_set_cancel_token(options, fresh, &error));
    delotet_mesh_free(mesh_with(plc, options));
    OK(delotet_options_set_cancel_token(options, cancelled, &error));
    OK(delotet_options_set_cancel_token(options, cancelled, &error));
    OK(delotet_options_set_cancel_token(options, NULL, &error));
    delotet_mesh_free(mesh_with(plc, options));
    FAILS(INVALID, delotet_options_set_cancel_token(NULL, fresh, &error));
    delotet_cancel_token_free(cancelled);
    delotet_cancel_token_free(fresh);
    delotet_plc_free(plc);
    delotet_options_free(options);
    return 0;
}
