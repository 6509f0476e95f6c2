/* What the checks of preserved meshes have in common: `check` accepts a mesh made with `strength`, and finds points on a surface. */
#ifndef DELOTET_TEST_PRESERVED_H
#define DELOTET_TEST_PRESERVED_H
#include "test.h"

typedef DelotetStatus (*PreservedCheck)(const DelotetMesh *, const DelotetPlc *, size_t, DelotetError **);

static inline void test_preserved_check(PreservedCheck check, DelotetPreserve strength)
{
    DelotetPlc *plc = twisted_prism(), *other = cube();
    DelotetOptions *options = delotet_options_new();
    DelotetMesh *split = mesh_with(plc, NULL), *kept, *plain = mesh_with(other, NULL);
    DelotetError *error = NULL;
    CHECK(check(split, plc, 3, &error) == DELOTET_STATUS_CHECK_FAILED);
    CHECK(delotet_error_defects(error).count >= 1 && delotet_error_defects(error).count <= 3);
    delotet_error_free(error);
    OK(delotet_mesh_check(split, plc, true, 10, &error));
    FAILS(DELOTET_STATUS_CHECK_FAILED, check(plain, plc, 3, &error));
    FAILS(INVALID, check(NULL, plc, 3, &error));
    FAILS(INVALID, check(split, NULL, 3, &error));
    OK(delotet_options_set_mode(options, DELOTET_MODE_PRESERVE, &error));
    OK(delotet_options_set_preserve(options, strength, &error));
    kept = mesh_with(plc, options);
    OK(check(kept, plc, 10, &error));
    OK(delotet_mesh_check(kept, plc, false, 10, &error));
    delotet_mesh_free(split);
    delotet_mesh_free(kept);
    delotet_mesh_free(plain);
    delotet_plc_free(plc);
    delotet_plc_free(other);
    delotet_options_free(options);
}
#endif
