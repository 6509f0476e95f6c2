/* delotet_mesh_point_markers: the input's, and the segment's at Steiner points. */
#include "test.h"

int main(void)
{
    static const int32_t markers[6] = {1, 2, 3, 4, 5, 6};
    DelotetPlc *plc = twisted_prism();
    DelotetMesh *mesh;
    DelotetMarkersView view;
    DelotetSteinerView steiner;
    uint32_t i, j;
    for (i = 0; i < 6; i++)
        for (j = 0; j < i; j++)
            if (!(i == 5 && j == 0) && !(i == 3 && j == 1) && !(i == 4 && j == 2)) /* Not the three diagonals through the outside. */
                OK(delotet_plc_add_segment(plc, i, j, 77, &error));
    OK(delotet_plc_set_point_markers(plc, markers, &error));
    mesh = mesh_of(plc);
    view = delotet_mesh_point_markers(mesh);
    steiner = delotet_mesh_steiner_points(mesh);
    CHECK(steiner.count > 0 && view.count == 6 + steiner.count);
    CHECK(memcmp(view.data, markers, sizeof markers) == 0);
    for (i = 0; i < steiner.count; i++)
        CHECK(view.data[6 + i] == 77 && DELOTET_AT(DelotetSteinerPoint, steiner, i)->segment != DELOTET_INVALID_INDEX);
    CHECK(delotet_mesh_point_markers(NULL).data == NULL);
    delotet_mesh_free(mesh);
    return 0;
}
