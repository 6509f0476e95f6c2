/* delotet_options_set_max_volume: no tetrahedron is larger where the surface is fine enough; nonsense is refused. */
#include "test.h"

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = grid_box();
    DelotetMesh *mesh;
    DelotetTetsView tets;
    size_t none, i;
    OK(delotet_options_set_mode(options, DELOTET_MODE_PRESERVE, &error));
    none = points_in_grid(plc, options);
    OK(delotet_options_set_max_volume(options, 0.2, &error));
    CHECK(none < points_in_grid(plc, options));
    mesh = mesh_with(plc, options);
    tets = delotet_mesh_tets(mesh);
    for (i = 0; i < tets.count; i++)
        CHECK(volume_of(delotet_mesh_points(mesh).data, tets.data + 4 * i) <= 0.2);
    delotet_mesh_free(mesh);
    OK(delotet_options_set_max_volume(options, 0, &error));
    CHECK(points_in_grid(plc, options) == none);
    FAILS(INVALID, delotet_options_set_max_volume(options, -1, &error));
    FAILS(INVALID, delotet_options_set_max_volume(options, NAN, &error));
    FAILS(INVALID, delotet_options_set_max_volume(options, INFINITY, &error));
    FAILS(INVALID, delotet_options_set_max_volume(NULL, 1, &error));
    delotet_plc_free(plc);
    delotet_options_free(options);
    return 0;
}
