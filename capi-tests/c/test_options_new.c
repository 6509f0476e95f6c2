/* delotet_options_new: defaults make the same mesh as no options. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = nested_boxes();
    DelotetMesh *a = mesh_with(plc, NULL), *b;
    DelotetTetsView s, t;
    CHECK(options != NULL);
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
