/* delotet_mesh_write_with: the options reach the file; what cannot be written is refused. */
#include "test.h"

/* The file has a line that starts so. */
static int has_line(const char *name, const char *start)
{
    char text[256];
    int found = 0;
    FILE *file = fopen(name, "r");
    CHECK(file != NULL);
    while (fgets(text, sizeof text, file))
        found |= strncmp(text, start, strlen(start)) == 0;
    fclose(file);
    return found;
}

int main(void)
{
    DelotetWriteOptions *options = delotet_write_options_new();
    DelotetPlc *plc = cube();
    DelotetMesh *mesh = mesh_with(plc, NULL);
    OK(delotet_mesh_write_with(mesh, plc, "write_with.msh", NULL, &error));
    CHECK(has_line("write_with.msh", "4.1 0 8"));
    OK(delotet_write_options_set_msh_version(options, DELOTET_MSH_2_2, &error));
    OK(delotet_write_options_set_region_name(options, 1, "steel", &error));
    OK(delotet_mesh_write_with(mesh, plc, "write_with.msh", options, &error));
    CHECK(has_line("write_with.msh", "2.2 0 8") && has_line("write_with.msh", "3 1 \"steel\""));
    OK(delotet_write_options_set_second_order(options, true, &error));
    OK(delotet_mesh_write_with(mesh, plc, "write_with.inp", options, &error));
    CHECK(has_line("write_with.inp", "*ELEMENT, TYPE=C3D10, ELSET=STEEL"));
    OK(delotet_write_options_set_subfaces(options, true, &error));
    OK(delotet_mesh_write_with(mesh, plc, "write_with.vtu", options, &error));
    CHECK(remove("write_with_subfaces.vtu") == 0 && remove("write_with.vtu") == 0);
    CHECK(remove("write_with.msh") == 0 && remove("write_with.inp") == 0);
    FAILS(DELOTET_STATUS_UNSUPPORTED, delotet_mesh_write_with(mesh, plc, "write_with.mesh", options, &error));
    FAILS(DELOTET_STATUS_UNSUPPORTED, delotet_mesh_write_with(mesh, plc, "write_with.off", options, &error));
    FAILS(DELOTET_STATUS_FILE, delotet_mesh_write_with(mesh, plc, "no/such/folder.vtu", options, &error));
    FAILS(INVALID, delotet_mesh_write_with(mesh, plc, NULL, options, &error));
    FAILS(INVALID, delotet_mesh_write_with(mesh, NULL, "write_with.vtu", options, &error));
    FAILS(INVALID, delotet_mesh_write_with(NULL, plc, "write_with.vtu", options, &error));
    delotet_mesh_free(mesh);
    delotet_plc_free(plc);
    delotet_write_options_free(options);
    return 0;
}
