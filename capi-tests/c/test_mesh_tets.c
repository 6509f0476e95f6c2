/* delotet_mesh_tets: positive, and they fill the domain. */
#include "test.h"

int main(void)
{
    DelotetMesh *mesh = mesh_of(cube());
    DelotetTetsView tets = delotet_mesh_tets(mesh);
    size_t i;
    CHECK(tets.count == 5 || tets.count == 6);
    for (i = 0; i < 4 * tets.count; i++)
        CHECK(tets.data[i] < 8);
    CHECK(near(volume(mesh), 1));
    CHECK(delotet_mesh_tets(NULL).data == NULL && delotet_mesh_tets(NULL).count == 0);
    delotet_mesh_free(mesh);
    return 0;
}
