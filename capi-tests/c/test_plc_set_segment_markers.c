/* delotet_plc_set_segment_markers: all at once; the mesh has them; NULL sets them to 0. */
#include "test.h"

int main(void)
{
    static const uint32_t ends[4] = {0, 1, 1, 3};
    static const int32_t markers[2] = {-7, 8};
    DelotetPlc *plc = cube();
    DelotetMesh *mesh;
    DelotetSubsegmentsView pieces;
    size_t i, seen = 0;
    OK(delotet_plc_add_segments(plc, ends, NULL, 2, &error));
    OK(delotet_plc_set_segment_markers(plc, markers, &error));
    CHECK(DELOTET_AT(DelotetSegment, delotet_plc_segments(plc), 0)->marker == -7);
    mesh = mesh_with(plc, NULL);
    pieces = delotet_mesh_subsegments(mesh);
    for (i = 0; i < pieces.count; i++)
        seen += DELOTET_AT(DelotetSubsegment, pieces, i)->marker == -7;
    CHECK(seen == 1);
    delotet_mesh_free(mesh);
    OK(delotet_plc_set_segment_markers(plc, NULL, &error));
    CHECK(DELOTET_AT(DelotetSegment, delotet_plc_segments(plc), 1)->marker == 0);
    FAILS(INVALID, delotet_plc_set_segment_markers(NULL, markers, &error));
    delotet_plc_free(plc);
    return 0;
}
