/* delotet_skinny_tets_free: NULL is ignored; a list outlives its mesh. */
#include "test.h"

int main(void)
{
    DelotetMesh *mesh = mesh_of(cube());
    DelotetSkinnyTets *tets = NULL;
    OK(delotet_skinny_tets_new(mesh, 0.7, &tets, &error));
    delotet_mesh_free(mesh);
    CHECK(delotet_skinny_tets_view(tets).count > 0);
    delotet_skinny_tets_free(tets);
    delotet_skinny_tets_free(NULL);
    return 0;
}
