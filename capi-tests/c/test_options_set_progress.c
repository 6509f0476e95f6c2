/* delotet_options_set_progress: phases in order, fractions that never decrease, and cancelling. */
#include "test.h"

struct seen {
    int calls, wrong;
    uint32_t phase;
    double fraction;
};

static int32_t watch(void *user_data, DelotetPhase phase, double fraction)
{
    struct seen *seen = (struct seen *)user_data;
    seen->wrong |= !(fraction >= 0 && fraction <= 1);
    seen->wrong |= (uint32_t)phase == seen->phase && fraction < seen->fraction;
    seen->wrong |= strcmp(delotet_phase_name(phase), "unknown") == 0;
    seen->phase = phase;
    seen->fraction = fraction;
    seen->calls++;
    return 0;
}

static int32_t refuse(void *user_data, DelotetPhase phase, double fraction)
{
    (void)user_data, (void)phase, (void)fraction;
    return -1;
}

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = nested_boxes();
    DelotetMesh *mesh;
    struct seen seen = {0, 0, 0, 0};
    OK(delotet_options_set_progress(options, watch, &seen, &error));
    mesh = mesh_with(plc, options);
    CHECK(seen.calls > 0 && !seen.wrong);
    delotet_mesh_free(mesh);
    OK(delotet_options_set_mode(options, DELOTET_MODE_PRESERVE, &error));
    mesh = mesh_with(plc, options);
    CHECK(!seen.wrong && seen.fraction >= 1);
    delotet_mesh_free(mesh);
    OK(delotet_options_set_progress(options, refuse, &seen, &error));
    FAILS(DELOTET_STATUS_CANCELLED, delotet_tetrahedralize(plc, options, &mesh, &error));
    CHECK(mesh == NULL);
    OK(delotet_options_set_progress(options, NULL, NULL, &error));
    delotet_mesh_free(mesh_with(plc, options));
    FAILS(INVALID, delotet_options_set_progress(NULL, watch, NULL, &error));
    delotet_plc_free(plc);
    delotet_options_free(options);
    return 0;
}
