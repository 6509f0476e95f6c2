/* delotet_mesh_read: what was written comes back, with its points' data; files and limits at fault. */
#include "test.h"

static void round_trip(const DelotetMesh *mesh, const DelotetPlc *plc, const char *path)
{
    DelotetMesh *read = NULL;
    OK(delotet_mesh_write(mesh, plc, path, &error));
    OK(delotet_mesh_read(path, NULL, &read, &error));
    CHECK(delotet_mesh_tets(read).count == delotet_mesh_tets(mesh).count && near(volume(read), volume(mesh)));
    CHECK(delotet_mesh_points(read).count == delotet_mesh_points(mesh).count);
    CHECK(memcmp(delotet_mesh_points(read).data, delotet_mesh_points(mesh).data,
                 delotet_mesh_points(mesh).count * 3 * sizeof(double)) == 0);
    CHECK(delotet_mesh_subfaces(read).count == delotet_mesh_subfaces(mesh).count);
    CHECK(delotet_mesh_input_point_count(read) == delotet_mesh_points(read).count);
    delotet_mesh_free(read);
}

int main(void)
{
    static const char *const names[] = {"r.ele", "r.node", "r.face", "r.edge", "r.neigh", "r.parents", "r.vtu", "r.msh",
                                        "r.mesh", "bad.mesh"};
    double attributes[16];
    DelotetPlc *plc = nested_boxes();
    DelotetMesh *mesh = mesh_with(plc, NULL), *read = NULL;
    DelotetOptions *options = delotet_options_new();
    FILE *file;
    size_t i;
    round_trip(mesh, plc, "r.vtu");
    round_trip(mesh, plc, "r.msh");
    round_trip(mesh, plc, "r.mesh");
    for (i = 0; i < 16; i++)
        attributes[i] = (double)i / 3;
    OK(delotet_plc_set_point_attributes(plc, attributes, 1, &error));
    round_trip(mesh, plc, "r.ele");
    OK(delotet_mesh_read("r.ele", options, &read, &error));
    CHECK(delotet_mesh_point_attributes(read).width == 1 && delotet_mesh_point_attributes(read).data[7] == attributes[7]);
    CHECK(DELOTET_AT(DelotetSubface, delotet_mesh_subfaces(read), 0)->marker == 7);
    delotet_mesh_free(read);
    OK(delotet_options_set_time_limit(options, 1e-9, &error));
    FAILS(DELOTET_STATUS_TIME_LIMIT, delotet_mesh_read("r.ele", options, &read, &error));
    CHECK(read == NULL);
    file = fopen("bad.mesh", "w");
    CHECK(file != NULL);
    fprintf(file, "MeshVersionFormatted 2\nDimension 3\nVertices 1\n0 0\n");
    fclose(file);
    FAILS(DELOTET_STATUS_FORMAT, delotet_mesh_read("bad.mesh", NULL, &read, &error));
    FAILS(DELOTET_STATUS_FILE, delotet_mesh_read("no/such/file.vtu", NULL, &read, &error));
    FAILS(DELOTET_STATUS_UNSUPPORTED, delotet_mesh_read("r.off", NULL, &read, &error));
    FAILS(INVALID, delotet_mesh_read(NULL, NULL, &read, &error));
    FAILS(INVALID, delotet_mesh_read("r.ele", NULL, NULL, &error));
    for (i = 0; i < sizeof names / sizeof *names; i++)
        remove(names[i]);
    delotet_options_free(options);
    delotet_mesh_free(mesh);
    delotet_plc_free(plc);
    return 0;
}
