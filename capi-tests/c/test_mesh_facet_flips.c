/* delotet_mesh_facet_flips: none unless merging is on. */
#include "test.h"

int main(void)
{
    DelotetMesh *mesh = mesh_of(cube());
    CHECK(delotet_mesh_facet_flips(mesh).first == NULL && delotet_mesh_facet_flips(mesh).count == 0);
    CHECK(delotet_mesh_facet_flips(NULL).count == 0);
    delotet_mesh_free(mesh);
    return 0;
}
