/* delotet_mesh_check_preserved_outer: the mode that keeps the surface passes, points on the outer boundary are found. */
#include "test.h"

int main(void)
{
    DelotetPlc *plc = twisted_prism(), *other = cube();
    DelotetOptions *options = delotet_options_new();
    DelotetMesh *split = mesh_with(plc, NULL), *kept, *plain = mesh_with(other, NULL);
    DelotetError *error = NULL;
    CHECK(delotet_mesh_check_preserved_outer(split, plc, 3, &error) == DELOTET_STATUS_CHECK_FAILED);
    CHECK(delotet_error_defects(error).count >= 1 && delotet_error_defects(error).count <= 3);
    delotet_error_free(error);
    OK(delotet_mesh_check(split, plc, true, 10, &error));
    FAILS(DELOTET_STATUS_CHECK_FAILED, delotet_mesh_check_preserved_outer(plain, plc, 3, &error));
    FAILS(INVALID, delotet_mesh_check_preserved_outer(NULL, plc, 3, &error));
    FAILS(INVALID, delotet_mesh_check_preserved_outer(split, NULL, 3, &error));
    CHECK(delotet_options_set_mode(options, DELOTET_MODE_PRESERVE) == DELOTET_STATUS_OK);
    CHECK(delotet_options_set_preserve(options, DELOTET_PRESERVE_OUTER) == DELOTET_STATUS_OK);
    kept = mesh_with(plc, options);
    OK(delotet_mesh_check_preserved_outer(kept, plc, 10, &error));
    OK(delotet_mesh_check(kept, plc, false, 10, &error));
    delotet_mesh_free(split);
    delotet_mesh_free(kept);
    delotet_mesh_free(plain);
    delotet_plc_free(plc);
    delotet_plc_free(other);
    delotet_options_free(options);
    return 0;
}
