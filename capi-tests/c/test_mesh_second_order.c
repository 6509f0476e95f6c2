/* delotet_mesh_second_order: each node in the middle of the edge that its order documents. */
#include "test.h"

int main(void)
{
    static const int ends[3][6][2] = {{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}},
                                      {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {2, 3}, {1, 3}},
                                      {{2, 3}, {0, 3}, {0, 1}, {1, 2}, {1, 3}, {0, 2}}};
    DelotetMesh *mesh = mesh_of(cube());
    const double *xyz = delotet_mesh_points(mesh).data;
    DelotetSecondOrderView view;
    DelotetEdgesView edges;
    uint32_t order;
    size_t tet, k, axis;
    OK(delotet_mesh_edges(mesh, &edges, &error));
    for (order = DELOTET_NODE_ORDER_VTK; order <= DELOTET_NODE_ORDER_TETGEN; order++) {
        OK(delotet_mesh_second_order(mesh, order, &view, &error));
        CHECK(view.node_count == edges.count && view.tet_count == delotet_mesh_tets(mesh).count);
        for (tet = 0; tet < view.tet_count; tet++)
            for (k = 0; k < 6; k++) {
                const uint32_t *nodes = view.tets + 10 * tet;
                const double *middle = view.nodes + 3 * (nodes[4 + k] - 8);
                CHECK(nodes[4 + k] >= 8 && nodes[4 + k] < 8 + view.node_count);
                for (axis = 0; axis < 3; axis++)
                    CHECK(2 * middle[axis] ==
                          xyz[3 * nodes[ends[order][k][0]] + axis] + xyz[3 * nodes[ends[order][k][1]] + axis]);
            }
    }
    FAILS(INVALID, delotet_mesh_second_order(mesh, 3, &view, &error));
    FAILS(INVALID, delotet_mesh_second_order(mesh, UINT32_MAX, &view, &error));
    FAILS(INVALID, delotet_mesh_second_order(NULL, 0, &view, &error));
    FAILS(INVALID, delotet_mesh_second_order(mesh, 0, NULL, &error));
    delotet_mesh_free(mesh);
    return 0;
}
