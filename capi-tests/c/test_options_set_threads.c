/* delotet_options_set_threads: the mesh is the same for any number; 0 means all processors. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = nested_boxes();
    DelotetMesh *a = mesh_with(plc, options), *b;
    DelotetTetsView s, t;
    OK(delotet_options_set_threads(options, 0, &error));
    delotet_mesh_free(a);
    a = mesh_with(plc, options);
    FAILS(INVALID, delotet_options_set_threads(NULL, 2, &error));
    OK(delotet_options_set_threads(options, 3, &error));
    b = mesh_with(plc, options);
    s = delotet_mesh_tets(a);
    t = delotet_mesh_tets(b);
    CHECK(s.count == t.count && memcmp(s.data, t.data, 16 * s.count) == 0);
    delotet_mesh_free(a);
    delotet_mesh_free(b);
    delotet_plc_free(plc);
    delotet_options_free(options);
    return 0;
}
