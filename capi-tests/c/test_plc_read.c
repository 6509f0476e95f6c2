/* delotet_plc_read: an OFF file; missing files and unknown formats. */
#include "test.h"

int main(void)
{
    DelotetPlc *plc = NULL;
    DelotetMesh *mesh;
    FILE *file = fopen("test_plc_read.off", "w");
    int i;
    CHECK(file != NULL);
    fprintf(file, "OFF\n8 12 0\n");
    for (i = 0; i < 8; i++)
        fprintf(file, "%d %d %d\n", i & 1, (i >> 1) & 1, (i >> 2) & 1);
    for (i = 0; i < 12; i++)
        fprintf(file, "3 %u %u %u\n", BOX[3 * i], BOX[3 * i + 1], BOX[3 * i + 2]);
    fclose(file);
    OK(delotet_plc_read("test_plc_read.off", &plc, &error));
    CHECK(delotet_plc_points(plc).count == 8 && delotet_plc_facet_count(plc) == 12);
    mesh = mesh_of(plc);
    CHECK(near(volume(mesh), 1));
    delotet_mesh_free(mesh);
    file = fopen("test_plc_read.off", "w");
    fprintf(file, "OFF\n8 12 0\n0 0\n");
    fclose(file);
    FAILS(DELOTET_STATUS_FORMAT, delotet_plc_read("test_plc_read.off", &plc, &error));
    CHECK(plc == NULL);
    remove("test_plc_read.off");
    FAILS(DELOTET_STATUS_FILE, delotet_plc_read("no/such/file.off", &plc, &error));
    FAILS(DELOTET_STATUS_UNSUPPORTED, delotet_plc_read("file.of_no_known_format", &plc, &error));
    FAILS(INVALID, delotet_plc_read(NULL, &plc, &error));
    FAILS(INVALID, delotet_plc_read("file.off", NULL, &error));
    return 0;
}
