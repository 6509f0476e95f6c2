/* delotet_mesh_write: a file that names every point and tetrahedron; folders that do not exist. */
#include "test.h"

int main(void)
{
    DelotetPlc *plc = cube();
    DelotetMesh *mesh = mesh_with(plc, NULL);
    char word[64];
    size_t numbers = 0;
    int tets = 0;
    FILE *file;
    OK(delotet_mesh_write(mesh, plc, "test_mesh_write.mesh", &error));
    file = fopen("test_mesh_write.mesh", "r");
    CHECK(file != NULL);
    while (fscanf(file, "%63s", word) == 1) {
        numbers++;
        if (strcmp(word, "Tetrahedra") == 0)
            CHECK(fscanf(file, "%d", &tets) == 1);
    }
    fclose(file);
    remove("test_mesh_write.mesh");
    CHECK(numbers > 32 && (size_t)tets == delotet_mesh_tets(mesh).count);
    FAILS(DELOTET_STATUS_FILE, delotet_mesh_write(mesh, plc, "no/such/folder/file.mesh", &error));
    FAILS(DELOTET_STATUS_UNSUPPORTED, delotet_mesh_write(mesh, plc, "file.of_no_known_format", &error));
    FAILS(INVALID, delotet_mesh_write(mesh, plc, NULL, &error));
    FAILS(INVALID, delotet_mesh_write(mesh, NULL, "file.mesh", &error));
    FAILS(INVALID, delotet_mesh_write(NULL, plc, "file.mesh", &error));
    delotet_mesh_free(mesh);
    delotet_plc_free(plc);
    return 0;
}
