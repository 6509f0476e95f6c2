/* delotet_options_set_preserve: both strengths keep a surface without internal facets; unknown ones are refused. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *prism = twisted_prism(), *boxes = nested_boxes();
    uint32_t strength;
    FAILS(INVALID, delotet_options_set_preserve(options, 2, &error));
    FAILS(INVALID, delotet_options_set_preserve(options, UINT32_MAX, &error));
    FAILS(INVALID, delotet_options_set_preserve(NULL, DELOTET_PRESERVE_ALL, &error));
    OK(delotet_options_set_mode(options, DELOTET_MODE_PRESERVE, &error));
    for (strength = DELOTET_PRESERVE_ALL; strength <= DELOTET_PRESERVE_OUTER; strength++) {
        DelotetMesh *first, *second;
        OK(delotet_options_set_preserve(options, strength, &error));
        first = mesh_with(prism, options);
        second = mesh_with(boxes, options);
        OK(delotet_mesh_check_preserved(first, prism, 10, &error));
        OK(delotet_mesh_check_preserved_outer(second, boxes, 10, &error));
        CHECK(near(volume(second), 27) && delotet_mesh_regions(second).count == 2);
        delotet_mesh_free(first);
        delotet_mesh_free(second);
    }
    delotet_plc_free(prism);
    delotet_plc_free(boxes);
    delotet_options_free(options);
    return 0;
}
