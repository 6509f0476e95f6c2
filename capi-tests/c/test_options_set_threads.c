/* delotet_options_set_threads: the mesh is the same for any number; 0 means all processors. The points are so many that threads are
   used; that they are started is seen by capi-tests/callers.rs. */
#include "test.h"

#define COUNT 72000

static double xyz[3 * COUNT];

int main(void)
{
    static const size_t numbers[2] = {3, 0};
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = NULL;
    DelotetMesh *one, *other;
    DelotetTetsView s, t;
    uint64_t state = 1;
    size_t i;
    for (i = 0; i < 3 * COUNT; i++) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        xyz[i] = (double)(state >> 11);
    }
    OK(delotet_plc_new(xyz, COUNT, &plc, &error));
    OK(delotet_options_set_mode(options, DELOTET_MODE_DELAUNAY, &error));
    FAILS(INVALID, delotet_options_set_threads(NULL, 2, &error));
    one = mesh_with(plc, options);
    s = delotet_mesh_tets(one);
    CHECK(s.count > 6 * COUNT);
    for (i = 0; i < 2; i++) {
        OK(delotet_options_set_threads(options, numbers[i], &error));
        other = mesh_with(plc, options);
        t = delotet_mesh_tets(other);
        CHECK(s.count == t.count && memcmp(s.data, t.data, 16 * s.count) == 0);
        delotet_mesh_free(other);
    }
    delotet_mesh_free(one);
    delotet_plc_free(plc);
    delotet_options_free(options);
    return 0;
}
