/* delotet_options_set_size_function: small lengths make points; what is no length is refused; cancelling; no wish. */
#include "test.h"

struct wish {
    double size;
    int32_t answer;
    int calls, wrong;
};

static int32_t ask(void *user_data, const double *point, double *size)
{
    struct wish *wish = (struct wish *)user_data;
    int i;
    wish->calls++;
    /* Without an answer there is no wish. */
    wish->wrong |= !(*size > 0 && isinf(*size));
    for (i = 0; i < 3; i++)
        wish->wrong |= !isfinite(point[i]);
    if (wish->size != 0)
        *size = wish->size;
    return wish->answer;
}

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = grid_box();
    DelotetMesh *mesh = NULL;
    struct wish wish = {0, 0, 0, 0};
    const double nonsense[3] = {-1, -INFINITY, NAN};
    size_t none;
    int i;
    OK(delotet_options_set_mode(options, DELOTET_MODE_PRESERVE, &error));
    OK(delotet_options_set_size_function(options, ask, &wish, &error));
    none = points_in_grid(plc, options);
    CHECK(wish.calls > 0 && !wish.wrong);
    wish.size = 0.5;
    CHECK(points_in_grid(plc, options) > none && !wish.wrong);
    for (i = 0; i < 3; i++) {
        wish.size = nonsense[i];
        FAILS(INVALID, delotet_tetrahedralize(plc, options, &mesh, &error));
        CHECK(mesh == NULL);
    }
    wish.size = 1;
    wish.answer = -1;
    wish.calls = 0;
    FAILS(DELOTET_STATUS_CANCELLED, delotet_tetrahedralize(plc, options, &mesh, &error));
    CHECK(mesh == NULL && wish.calls == 1);
    OK(delotet_options_set_size_function(options, NULL, &wish, &error));
    delotet_mesh_free(mesh_with(plc, options));
    CHECK(wish.calls == 1);
    FAILS(INVALID, delotet_options_set_size_function(NULL, ask, NULL, &error));
    delotet_plc_free(plc);
    delotet_options_free(options);
    return 0;
}
