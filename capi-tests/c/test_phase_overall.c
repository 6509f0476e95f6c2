/* delotet_phase_overall: one number for the whole run that never decreases, on every path. */
#include "test.h"

struct seen {
    uint32_t phase;
    double fraction, overall;
    int calls, refines, optimizes;
};

/* Phases by their order in a run. */
static int place(uint32_t phase)
{
    static const uint32_t order[] = {DELOTET_PHASE_READ, DELOTET_PHASE_VALIDATE, DELOTET_PHASE_DELAUNAY, DELOTET_PHASE_SEGMENTS,
        DELOTET_PHASE_FACETS, DELOTET_PHASE_REGIONS, DELOTET_PHASE_PRESERVE, DELOTET_PHASE_REFINE, DELOTET_PHASE_ROUND,
        DELOTET_PHASE_OPTIMIZE, DELOTET_PHASE_AUDIT, DELOTET_PHASE_WRITE};
    const int count = (int)(sizeof order / sizeof *order);
    int i;
    for (i = 0; i < count; i++)
        if (order[i] == phase)
            return i;
    CHECK(!"a known phase");
    return -1;
}

static int32_t watch(void *user_data, DelotetPhase phase, double fraction)
{
    struct seen *seen = (struct seen *)user_data;
    double overall = delotet_phase_overall((uint32_t)phase, fraction);
    CHECK(fraction >= 0 && fraction <= 1);
    if (seen->calls++) {
        CHECK(place((uint32_t)phase) >= place(seen->phase));
        CHECK((uint32_t)phase == seen->phase ? fraction >= seen->fraction : seen->fraction == 1);
        CHECK(overall >= seen->overall);
    }
    seen->refines |= phase == DELOTET_PHASE_REFINE;
    seen->optimizes |= phase == DELOTET_PHASE_OPTIMIZE;
    seen->phase = (uint32_t)phase;
    seen->fraction = fraction;
    seen->overall = overall;
    return 0;
}

int main(void)
{
    static const DelotetMode modes[] = {DELOTET_MODE_DELAUNAY, DELOTET_MODE_CONSTRAINED, DELOTET_MODE_PRESERVE};
    DelotetPlc *plc = nested_boxes();
    int i, merged, shaped;
    for (i = 0; i < 3; i++)
        for (merged = 0; merged < 2; merged++)
            for (shaped = 0; shaped < (modes[i] == DELOTET_MODE_DELAUNAY ? 1 : 2); shaped++) {
                DelotetOptions *options = delotet_options_new();
                struct seen seen = {0, 0, 0, 0, 0, 0};
                OK(delotet_options_set_mode(options, modes[i], &error));
                OK(delotet_options_set_merge_facets(options, merged ? 175 : 0, &error));
                OK(delotet_options_set_quality(options, shaped ? 2 : 0, &error));
                OK(delotet_options_set_optimize(options, (uint32_t)shaped, &error));
                OK(delotet_options_set_progress(options, watch, &seen, &error));
                delotet_mesh_free(mesh_with(plc, options));
                CHECK(seen.phase == DELOTET_PHASE_AUDIT && seen.fraction == 1 && seen.overall > 0.8);
                CHECK(seen.refines == shaped && seen.optimizes == shaped);
                delotet_options_free(options);
            }
    CHECK(delotet_phase_overall(DELOTET_PHASE_READ, 0) == 0 && delotet_phase_overall(DELOTET_PHASE_WRITE, 1) == 1);
    CHECK(delotet_phase_overall(DELOTET_PHASE_WRITE, 7) == 1 && delotet_phase_overall(99, 0.5) == 0);
    delotet_plc_free(plc);
    return 0;
}
