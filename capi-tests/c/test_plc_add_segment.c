/* delotet_plc_add_segment: inside a cube it becomes an edge with its marker. */
#include "test.h"

int main(void)
{
    double xyz[30];
    DelotetPlc *plc = NULL;
    DelotetMesh *mesh;
    DelotetSubsegmentsView pieces;
    size_t i, found = 0;
    box_points(xyz, 0, 1);
    xyz[24] = xyz[25] = xyz[26] = 0.25;
    xyz[27] = xyz[28] = 0.25, xyz[29] = 0.75;
    OK(delotet_plc_new(xyz, 10, &plc, &error));
    OK(delotet_plc_add_triangles(plc, BOX, NULL, 12, &error));
    OK(delotet_plc_add_segment(plc, 8, 9, -5, &error));
    FAILS(DELOTET_STATUS_INDEX_OUT_OF_RANGE, delotet_plc_add_segment(plc, 8, 10, 0, &error));
    FAILS(DELOTET_STATUS_INDEX_OUT_OF_RANGE, delotet_plc_add_segment(plc, DELOTET_INVALID_INDEX, 0, 0, &error));
    FAILS(INVALID, delotet_plc_add_segment(NULL, 0, 1, 0, &error));
    CHECK(delotet_plc_segment_count(plc) == 1);
    mesh = mesh_of(plc);
    pieces = delotet_mesh_subsegments(mesh);
    for (i = 0; i < pieces.count; i++)
        if (DELOTET_AT(DelotetSubsegment, pieces, i)->segment == 0) {
            CHECK(DELOTET_AT(DelotetSubsegment, pieces, i)->marker == -5);
            found++;
        }
    CHECK(found >= 1);
    delotet_mesh_free(mesh);
    return 0;
}
