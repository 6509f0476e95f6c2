/* delotet_mesh_tet_edges: edges 01 02 03 12 13 23. */
#include "test.h"

int main(void)
{
    static const int ends[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
    DelotetMesh *mesh = mesh_of(cube());
    DelotetEdgesView edges;
    DelotetIndexRowsView of;
    size_t tet, k;
    OK(delotet_mesh_edges(mesh, &edges, &error));
    OK(delotet_mesh_tet_edges(mesh, &of, &error));
    CHECK(of.count == delotet_mesh_tets(mesh).count && of.width == 6);
    for (tet = 0; tet < of.count; tet++)
        for (k = 0; k < 6; k++) {
            uint32_t a = delotet_mesh_tets(mesh).data[4 * tet + (size_t)ends[k][0]];
            uint32_t b = delotet_mesh_tets(mesh).data[4 * tet + (size_t)ends[k][1]];
            DelotetEdge edge = *DELOTET_AT(DelotetEdge, edges, of.data[6 * tet + k]);
            CHECK((edge.ends[0] == a && edge.ends[1] == b) || (edge.ends[0] == b && edge.ends[1] == a));
        }
    FAILS(INVALID, delotet_mesh_tet_edges(NULL, &of, &error));
    FAILS(INVALID, delotet_mesh_tet_edges(mesh, NULL, &error));
    delotet_mesh_free(mesh);
    return 0;
}
