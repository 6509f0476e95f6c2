/* delotet_mesh_refine: points come inside, what is kept stays with its data; sizes of another mesh, limits. */
#include "test.h"

int main(void)
{
    double attributes[GRID * GRID * 6 + 2];
    double *lengths;
    DelotetPlc *plc = grid_box();
    const size_t inputs = delotet_plc_points(plc).count;
    DelotetOptions *options = delotet_options_new();
    DelotetMeshSizes *sizes = delotet_mesh_sizes_new();
    DelotetMesh *mesh, *fine = NULL, *same = NULL;
    DelotetCancelToken *token = delotet_cancel_token_new();
    size_t count, i;
    for (i = 0; i < inputs; i++)
        attributes[i] = delotet_plc_points(plc).data[3 * i];
    OK(delotet_plc_set_point_attributes(plc, attributes, 1, &error));
    OK(delotet_options_set_mode(options, DELOTET_MODE_PRESERVE, &error));
    mesh = mesh_with(plc, options);
    count = delotet_mesh_points(mesh).count;

    OK(delotet_options_set_size(options, 1, &error));
    OK(delotet_mesh_refine(mesh, NULL, options, &fine, &error));
    OK(delotet_mesh_check_preserved(fine, plc, 10, &error));
    CHECK(delotet_mesh_points(fine).count > count && delotet_mesh_input_point_count(fine) == inputs);
    CHECK(delotet_mesh_subfaces(fine).count == delotet_mesh_subfaces(mesh).count);
    CHECK(near(volume(fine), volume(mesh)));
    /* The attribute is linear, so it is reproduced up to rounding. */
    for (i = 0; i < delotet_mesh_points(fine).count; i++)
        CHECK(fabs(delotet_mesh_point_attributes(fine).data[i] - delotet_mesh_points(fine).data[3 * i]) < 1e-9);
    OK(delotet_mesh_refine(mesh, sizes, options, &same, &error));
    CHECK(delotet_mesh_tets(same).count == delotet_mesh_tets(fine).count);
    CHECK(memcmp(delotet_mesh_tets(same).data, delotet_mesh_tets(fine).data, delotet_mesh_tets(fine).count * 16) == 0);
    delotet_mesh_free(same);

    /* A size at every point of the refined mesh. */
    count = delotet_mesh_points(fine).count;
    lengths = (double *)malloc(count * sizeof *lengths);
    CHECK(lengths != NULL);
    for (i = 0; i < count; i++)
        lengths[i] = 0.6;
    OK(delotet_mesh_sizes_set_points(sizes, lengths, count, &error));
    OK(delotet_mesh_refine(fine, sizes, NULL, &same, &error));
    CHECK(delotet_mesh_points(same).count > count);
    OK(delotet_mesh_check_preserved(same, plc, 10, &error));
    delotet_mesh_free(same);
    FAILS(INVALID, delotet_mesh_refine(mesh, sizes, NULL, &same, &error));
    CHECK(same == NULL);

    FAILS(INVALID, delotet_mesh_refine(NULL, NULL, NULL, &same, &error));
    FAILS(INVALID, delotet_mesh_refine(mesh, NULL, NULL, NULL, &error));
    OK(delotet_options_set_steiner_limit(options, 1, &error));
    FAILS(DELOTET_STATUS_STEINER_LIMIT, delotet_mesh_refine(mesh, NULL, options, &same, &error));
    OK(delotet_options_set_steiner_limit(options, UINT64_MAX, &error));
    OK(delotet_options_set_size(options, 1e-7, &error));
    FAILS(DELOTET_STATUS_TOO_LARGE, delotet_mesh_refine(mesh, NULL, options, &same, &error));
    OK(delotet_options_set_size(options, 0.02, &error));
    OK(delotet_options_set_time_limit(options, 0.01, &error));
    FAILS(DELOTET_STATUS_TIME_LIMIT, delotet_mesh_refine(mesh, NULL, options, &same, &error));
    OK(delotet_options_set_time_limit(options, 0, &error));
#ifdef __linux__
    OK(delotet_options_set_memory_limit(options, 1000 * 1000, &error));
    FAILS(DELOTET_STATUS_MEMORY_LIMIT, delotet_mesh_refine(mesh, NULL, options, &same, &error));
    OK(delotet_options_set_memory_limit(options, 0, &error));
#endif
    OK(delotet_options_set_cancel_token(options, token, &error));
    delotet_cancel_token_cancel(token);
    FAILS(DELOTET_STATUS_CANCELLED, delotet_mesh_refine(mesh, NULL, options, &same, &error));
    CHECK(same == NULL);
    free(lengths);
    delotet_cancel_token_free(token);
    delotet_mesh_free(fine);
    delotet_mesh_free(mesh);
    delotet_mesh_sizes_free(sizes);
    delotet_options_free(options);
    delotet_plc_free(plc);
    return 0;
}
