/* delotet_mesh_subsegments: edges of facets and marked segments. */
#include "test.h"

int main(void)
{
    DelotetPlc *plc = cube();
    DelotetMesh *mesh;
    DelotetSubsegmentsView pieces;
    size_t i, marked = 0;
    OK(delotet_plc_add_segment(plc, 0, 1, 9, &error));
    mesh = mesh_of(plc);
    pieces = delotet_mesh_subsegments(mesh);
    CHECK(pieces.count >= 12);
    for (i = 0; i < pieces.count; i++) {
        const DelotetSubsegment *piece = DELOTET_AT(DelotetSubsegment, pieces, i);
        if (piece->segment == 0) {
            CHECK(piece->marker == 9);
            CHECK(piece->ends[0] + piece->ends[1] == 1);
            marked++;
        } else
            CHECK(piece->segment == DELOTET_INVALID_INDEX && piece->marker == 0);
    }
    CHECK(marked == 1);
    CHECK(delotet_mesh_subsegments(NULL).first == NULL);
    delotet_mesh_free(mesh);
    return 0;
}
