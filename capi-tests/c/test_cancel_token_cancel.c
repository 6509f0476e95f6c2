/* delotet_cancel_token_cancel: from another thread, in the middle of a run; and before runs, of any number of options. */
#include "test.h"
#include <pthread.h>

static DelotetCancelToken *token;
static pthread_t thread;
static int started;

static void *cancel(void *unused)
{
    (void)unused;
    delotet_cancel_token_cancel(token);
    return NULL;
}

/* The other thread begins in the middle of the run, which waits for it here: however slow the machine, the run goes on cancelled. */
static int32_t start(void *user_data, DelotetPhase phase, double fraction)
{
    (void)user_data, (void)fraction;
    if (phase == DELOTET_PHASE_DELAUNAY && !started) {
        started = pthread_create(&thread, NULL, cancel, NULL) == 0;
        CHECK(started && pthread_join(thread, NULL) == 0);
    }
    CHECK(phase != DELOTET_PHASE_AUDIT);
    return 0;
}

int main(void)
{
    DelotetOptions *options = delotet_options_new(), *others = delotet_options_new();
    DelotetPlc *plc = cloud(3000), *small = cube();
    DelotetMesh *mesh;
    token = delotet_cancel_token_new();
    OK(delotet_options_set_mode(options, DELOTET_MODE_DELAUNAY, &error));
    OK(delotet_options_set_cancel_token(options, token, &error));
    OK(delotet_options_set_cancel_token(others, token, &error));
    delotet_mesh_free(mesh_with(small, others));
    OK(delotet_options_set_progress(options, start, NULL, &error));
    FAILS(DELOTET_STATUS_CANCELLED, delotet_tetrahedralize(plc, options, &mesh, &error));
    CHECK(started && mesh == NULL);
    FAILS(DELOTET_STATUS_CANCELLED, delotet_tetrahedralize(small, others, &mesh, &error));
    FAILS(DELOTET_STATUS_CANCELLED, delotet_plc_check(small, others, &error));
    delotet_cancel_token_cancel(token);
    CHECK(delotet_cancel_token_is_cancelled(token));
    delotet_cancel_token_cancel(NULL);
    delotet_cancel_token_free(token);
    delotet_plc_free(plc);
    delotet_plc_free(small);
    delotet_options_free(options);
    delotet_options_free(others);
    return 0;
}
