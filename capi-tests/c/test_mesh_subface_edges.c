/* delotet_mesh_subface_edges: edges ab bc ca of every subface. */
#include "test.h"

int main(void)
{
    DelotetMesh *mesh = mesh_of(cube());
    DelotetEdgesView edges;
    DelotetIndexRowsView of;
    size_t i, k;
    OK(delotet_mesh_edges(mesh, &edges, &error));
    OK(delotet_mesh_subface_edges(mesh, &of, &error));
    CHECK(of.count == delotet_mesh_subfaces(mesh).count && of.width == 3);
    for (i = 0; i < of.count; i++)
        for (k = 0; k < 3; k++) {
            uint32_t a = DELOTET_AT(DelotetSubface, delotet_mesh_subfaces(mesh), i)->corners[k];
            uint32_t b = DELOTET_AT(DelotetSubface, delotet_mesh_subfaces(mesh), i)->corners[(k + 1) % 3];
            DelotetEdge edge = *DELOTET_AT(DelotetEdge, edges, of.data[3 * i + k]);
            CHECK((edge.ends[0] == a && edge.ends[1] == b) || (edge.ends[0] == b && edge.ends[1] == a));
        }
    FAILS(INVALID, delotet_mesh_subface_edges(NULL, &of, &error));
    FAILS(INVALID, delotet_mesh_subface_edges(mesh, NULL, &error));
    delotet_mesh_free(mesh);
    return 0;
}
