/* delotet_mesh_edges: ascending, each with a tetrahedron; subsegments are marked. */
#include "test.h"

int main(void)
{
    DelotetPlc *plc = cube();
    DelotetMesh *mesh;
    DelotetEdgesView edges;
    size_t i, marked = 0;
    OK(delotet_plc_add_segment(plc, 5, 7, 3, &error));
    mesh = mesh_of(plc);
    OK(delotet_mesh_edges(mesh, &edges, &error));
    for (i = 0; i < edges.count; i++) {
        const DelotetEdge *edge = DELOTET_AT(DelotetEdge, edges, i), *before = i ? DELOTET_AT(DelotetEdge, edges, i - 1) : NULL;
        const uint32_t *tet = delotet_mesh_tets(mesh).data + 4 * edge->tet;
        int corner, ends = 0;
        CHECK(edge->ends[0] < edge->ends[1]);
        CHECK(!before || before->ends[0] < edge->ends[0] ||
              (before->ends[0] == edge->ends[0] && before->ends[1] < edge->ends[1]));
        for (corner = 0; corner < 4; corner++)
            ends += tet[corner] == edge->ends[0] || tet[corner] == edge->ends[1];
        CHECK(ends == 2);
        if (edge->marker == 3) {
            CHECK(edge->ends[0] == 5 && edge->ends[1] == 7);
            CHECK(DELOTET_AT(DelotetSubsegment, delotet_mesh_subsegments(mesh), edge->subsegment)->segment == 0);
            marked++;
        }
    }
    CHECK(marked == 1);
    FAILS(INVALID, delotet_mesh_edges(NULL, &edges, &error));
    FAILS(INVALID, delotet_mesh_edges(mesh, NULL, &error));
    delotet_mesh_free(mesh);
    return 0;
}
