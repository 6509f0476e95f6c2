/* delotet_mesh_check: a mesh passes against its PLC and fails against another. */
#include "test.h"

int main(void)
{
    DelotetPlc *plc = nested_boxes(), *other = cube();
    DelotetMesh *mesh = mesh_with(plc, NULL);
    DelotetError *error = NULL;
    OK(delotet_mesh_check(mesh, plc, true, 10, &error));
    OK(delotet_mesh_check(mesh, plc, false, 10, &error));
    CHECK(delotet_mesh_check(mesh, other, true, 3, &error) == DELOTET_STATUS_CHECK_FAILED);
    CHECK(delotet_error_defects(error).count >= 1 && delotet_error_defects(error).count <= 3);
    delotet_error_free(error);
    FAILS(INVALID, delotet_mesh_check(NULL, plc, true, 3, &error));
    FAILS(INVALID, delotet_mesh_check(mesh, NULL, true, 3, &error));
    delotet_mesh_free(mesh);
    delotet_plc_free(plc);
    delotet_plc_free(other);
    return 0;
}
