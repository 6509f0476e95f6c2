/* DELOTET_AT: steps by the view's stride, so that records of a later library with more fields are read correctly. */
#include "test.h"

typedef struct {
    DelotetEdge known;
    double appended[2];
} LaterEdge;

int main(void)
{
    DelotetMesh *mesh = mesh_of(cube());
    LaterEdge later[3];
    DelotetEdgesView view;
    uint32_t i;
    memset(later, 0, sizeof later);
    for (i = 0; i < 3; i++) {
        later[i].known.tet = 10 + i;
        later[i].known.marker = -(int32_t)i;
        later[i].appended[0] = 1e300;
    }
    view.first = &later[0].known;
    view.count = 3;
    view.stride = sizeof *later;
    for (i = 0; i < 3; i++)
        CHECK(DELOTET_AT(DelotetEdge, view, i)->tet == 10 + i && DELOTET_AT(DelotetEdge, view, i)->marker == -(int32_t)i);
    /* This library's own. */
    OK(delotet_mesh_edges(mesh, &view, &error));
    CHECK(view.stride == sizeof(DelotetEdge));
    CHECK(DELOTET_AT(DelotetEdge, view, view.count - 1) == view.first + (view.count - 1));
    delotet_mesh_free(mesh);
    return 0;
}
