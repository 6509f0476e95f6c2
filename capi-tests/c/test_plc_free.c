/* delotet_plc_free: NULL is ignored; meshes stay valid. */
#include "test.h"

int main(void)
{
    DelotetPlc *plc = cube();
    DelotetMesh *mesh = mesh_with(plc, NULL);
    delotet_plc_free(NULL);
    delotet_plc_free(plc);
    CHECK(near(volume(mesh), 1));
    delotet_mesh_free(mesh);
    return 0;
}
