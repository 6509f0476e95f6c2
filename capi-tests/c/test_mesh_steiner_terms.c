/* delotet_mesh_steiner_terms: none as a rule; segments almost in one line need them. */
#include "test.h"

int main(void)
{
    static const double xyz[36] = {-1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1, -1, -1, -1, 1, 1, -1, 1,
                                   -1, 1, 1, 1, 1, 1, 0, 0, 0, 0.75, 0, 0, 0.5, 1e-25, 0, 0.3, 0, 1e-25};
    static const uint32_t ends[6] = {8, 9, 8, 10, 8, 11};
    DelotetPlc *plc = NULL;
    DelotetOptions *options = NULL;
    DelotetMesh *mesh = mesh_of(twisted_prism());
    DelotetSteinerTermsView terms;
    size_t i;
    CHECK(delotet_mesh_steiner_points(mesh).count > 0);
    CHECK(delotet_mesh_steiner_terms(mesh).first == NULL && delotet_mesh_steiner_terms(mesh).count == 0);
    CHECK(delotet_mesh_steiner_terms(NULL).count == 0);
    delotet_mesh_free(mesh);

    OK(delotet_plc_new(xyz, 12, &plc, &error));
    OK(delotet_plc_add_segments(plc, ends, NULL, 3, &error));
    options = delotet_options_new();
    OK(delotet_options_set_keep_hull(options, true, &error));
    mesh = mesh_with(plc, options);
    terms = delotet_mesh_steiner_terms(mesh);
    CHECK(terms.count > 0);
    for (i = 0; i < terms.count; i++) {
        const DelotetSteinerTerm *term = DELOTET_AT(DelotetSteinerTerm, terms, i);
        CHECK(term->steiner < delotet_mesh_steiner_points(mesh).count);
        CHECK(term->value != 0 && fabs(term->value) < 1e-16);
        CHECK(i == 0 || DELOTET_AT(DelotetSteinerTerm, terms, i - 1)->steiner <= term->steiner);
    }
    OK(delotet_mesh_check(mesh, plc, true, 0, &error));
    delotet_mesh_free(mesh);
    delotet_options_free(options);
    delotet_plc_free(plc);
    return 0;
}
