/* delotet_write_options_set_log: options without effect and values that a format cannot hold are logged, a line each. */
#include "test.h"

static void line(void *user_data, const char *message)
{
    int *count = (int *)user_data;
    CHECK(strncmp(message, "warning: ", 9) == 0 && strchr(message, '\n') == NULL);
    (*count)++;
}

int main(void)
{
    static const double seed[3] = {0.5, 0.5, 0.5};
    DelotetWriteOptions *options = delotet_write_options_new();
    DelotetPlc *plc = cube();
    DelotetMesh *mesh;
    int count = 0;
    OK(delotet_plc_add_region(plc, seed, 2.5, 0, &error));
    mesh = mesh_with(plc, NULL);
    OK(delotet_write_options_set_log(options, line, &count, &error));
    OK(delotet_mesh_write_with(mesh, plc, "write_log.vtu", options, &error));
    CHECK(count == 0);
    OK(delotet_write_options_set_compress(options, true, &error));
    OK(delotet_mesh_write_with(mesh, plc, "write_log.msh", options, &error));
    CHECK(count == 2); /* Nothing is compressed; the attribute 2.5 is no tag. */
    OK(delotet_write_options_set_log(options, NULL, NULL, &error));
    OK(delotet_mesh_write_with(mesh, plc, "write_log.msh", options, &error));
    CHECK(count == 2);
    FAILS(INVALID, delotet_write_options_set_log(NULL, line, NULL, &error));
    CHECK(remove("write_log.vtu") == 0 && remove("write_log.msh") == 0);
    delotet_mesh_free(mesh);
    delotet_plc_free(plc);
    delotet_write_options_free(options);
    return 0;
}
