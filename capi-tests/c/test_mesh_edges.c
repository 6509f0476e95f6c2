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
        const uint32_t *tet = delotet_mesh_tets(mesh).data + 4 * edges.data[i].tet;
        int corner, ends = 0;
        CHECK(edges.data[i].ends[0] < edges.data[i].ends[1]);
        CHECK(i == 0 || edges.data[i - 1].ends[0] < edges.data[i].ends[0] ||
              (edges.data[i - 1].ends[0] == edges.data[i].ends[0] && edges.data[i - 1].ends[1] < edges.data[i].ends[1]));
        for (corner = 0; corner < 4; corner++)
            ends += tet[corner] == edges.data[i].ends[0] || tet[corner] == edges.data[i].ends[1];
        CHECK(ends == 2);
        if (edges.data[i].marker == 3) {
            CHECK(edges.data[i].ends[0] == 5 && edges.data[i].ends[1] == 7);
            CHECK(delotet_mesh_subsegments(mesh).data[edges.data[i].subsegment].segment == 0);
            marked++;
        }
    }
    CHECK(marked == 1);
    FAILS(INVALID, delotet_mesh_edges(NULL, &edges, &error));
    FAILS(INVALID, delotet_mesh_edges(mesh, NULL, &error));
    delotet_mesh_free(mesh);
    return 0;
}
