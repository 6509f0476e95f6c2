/* delotet_options_set_validate: a valid PLC gives the same mesh without validation. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = cube();
    DelotetMesh *mesh;
    OK(delotet_options_set_validate(options, false, &error));
    mesh = mesh_with(plc, options);
    CHECK(near(volume(mesh), 1));
    delotet_mesh_free(mesh);
    FAILS(INVALID, delotet_options_set_validate(NULL, false, &error));
    delotet_plc_free(plc);
    delotet_options_free(options);
    return 0;
}
