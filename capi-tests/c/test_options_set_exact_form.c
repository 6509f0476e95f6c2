/* delotet_options_set_exact_form: where doubles are too coarse, the mesh is returned anyway and lists the points. */
#include "test.h"

/* A twisted prism among the integers beyond 2^52: its edges must be split, and no double lies between. */
static DelotetPlc *coarse_prism(void)
{
    const double o = 4503599627370496.0;
    const double xyz[18] = {2 + o, o, 1 + o, 3 + o, 1 + o, 1 + o, 3 + o, 2 + o, o,
                            3 + o, 1 + o, o, o, o, o, 1 + o, 1 + o, 1 + o};
    const uint32_t triangles[24] = {0, 2, 1, 3, 4, 5, 0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 2, 0, 3, 2, 3, 5};
    DelotetPlc *plc = NULL;
    OK(delotet_plc_new(xyz, 6, &plc, &error));
    OK(delotet_plc_add_triangles(plc, triangles, NULL, 8, &error));
    return plc;
}

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = coarse_prism();
    DelotetMesh *mesh = NULL;
    DelotetError *why = NULL;
    CHECK(delotet_tetrahedralize(plc, options, &mesh, &why) == DELOTET_STATUS_ROUNDING);
    CHECK(mesh == NULL && delotet_error_defects(why).count > 0);
    delotet_error_free(why);
    OK(delotet_options_set_exact_form(options, true, &error));
    mesh = mesh_with(plc, options);
    CHECK(delotet_mesh_crowded_points(mesh).count > 0);
    delotet_mesh_free(mesh);
    FAILS(INVALID, delotet_options_set_exact_form(NULL, true, &error));
    delotet_plc_free(plc);
    delotet_options_free(options);
    return 0;
}
