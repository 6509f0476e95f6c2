/* delotet_options_set_optimize: the smallest angle of a filled mesh gets no worse, and the surface is kept, or refined in mode cdt; mode delaunay refuses, and
   so does mode cdt with the exact form. */
#include "test.h"

static double least_angle(DelotetOptions *options, const DelotetPlc *plc, uint32_t effort)
{
    DelotetQualitySummary summary;
    DelotetMesh *mesh;
    OK(delotet_options_set_optimize(options, effort, &error));
    mesh = mesh_with(plc, options);
    if (delotet_options_mode(options) == DELOTET_MODE_PRESERVE)
        OK(delotet_mesh_check_preserved(mesh, plc, 10, &error));
    else /* After optimisation it need not be Delaunay. */
        OK(delotet_mesh_check(mesh, plc, effort == 0, 10, &error));
    CHECK(fabs(volume(mesh) - GRID * GRID * GRID) < 1e-9);
    summary.struct_size = sizeof summary;
    OK(delotet_mesh_quality_summary(mesh, &summary, &error));
    delotet_mesh_free(mesh);
    return summary.worst[DELOTET_QUALITY_MIN_DIHEDRAL];
}

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = grid_box();
    DelotetMesh *mesh = NULL;
    double before;
    OK(delotet_options_set_mode(options, DELOTET_MODE_PRESERVE, &error));
    OK(delotet_options_set_size(options, 2, &error));
    before = least_angle(options, plc, 0);
    CHECK(least_angle(options, plc, 1) >= before);
    FAILS(INVALID, delotet_options_set_optimize(NULL, 1, &error));
    OK(delotet_options_set_mode(options, DELOTET_MODE_CONSTRAINED, &error));
    before = least_angle(options, plc, 0);
    CHECK(least_angle(options, plc, 1) >= before);
    OK(delotet_options_set_size(options, 0, &error));
    OK(delotet_options_set_exact_form(options, true, &error));
    FAILS(INVALID, delotet_tetrahedralize(plc, options, &mesh, &error));
    OK(delotet_options_set_exact_form(options, false, &error));
    OK(delotet_options_set_mode(options, DELOTET_MODE_DELAUNAY, &error));
    FAILS(INVALID, delotet_tetrahedralize(plc, options, &mesh, &error));
    CHECK(mesh == NULL);
    delotet_plc_free(plc);
    delotet_options_free(options);
    return 0;
}
