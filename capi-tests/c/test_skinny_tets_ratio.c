/* delotet_skinny_tets_ratio: the one that was given. */
#include "test.h"

int main(void)
{
    DelotetMesh *mesh = mesh_of(cube());
    DelotetSkinnyTets *tets = NULL;
    OK(delotet_skinny_tets_new(mesh, 0.8, &tets, &error));
    CHECK(delotet_skinny_tets_ratio(tets) == 0.8 && delotet_skinny_tets_ratio(NULL) == 0);
    delotet_skinny_tets_free(tets);
    delotet_mesh_free(mesh);
    return 0;
}
