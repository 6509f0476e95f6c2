/* delotet_options_set_validate: a valid PLC gives the same mesh without validation. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = cube();
    DelotetMesh *mesh;
    CHECK(delotet_options_set_validate(options, false) == DELOTET_STATUS_OK);
    mesh = mesh_with(plc, options);
    CHECK(near(volume(mesh), 1));
    delotet_mesh_free(mesh);
    CHECK(delotet_options_set_validate(NULL, false) == INVALID);
    delotet_plc_free(plc);
    delotet_options_free(options);
    return 0;
}
