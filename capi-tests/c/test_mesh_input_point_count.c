/* delotet_mesh_input_point_count: without the Steiner points. */
#include "test.h"

int main(void)
{
    DelotetMesh *mesh = mesh_of(twisted_prism());
    CHECK(delotet_mesh_input_point_count(mesh) == 6);
    CHECK(delotet_mesh_input_point_count(NULL) == 0);
    delotet_mesh_free(mesh);
    return 0;
}
