/* delotet_voronoi_new: of Delaunay meshes only; a limit or a token of the options ends it. */
#include "voronoi.h"

int main(void)
{
    DelotetPlc *plc = grid_points(), *box = cube();
    DelotetMesh *mesh = delaunay_of(plc), *other = mesh_of(box);
    DelotetOptions *options = delotet_options_new();
    DelotetCancelToken *token = delotet_cancel_token_new();
    DelotetVoronoi *voronoi = NULL;
    OK(delotet_voronoi_new(mesh, options, &voronoi, &error));
    CHECK(voronoi != NULL);
    delotet_voronoi_free(voronoi);
    FAILS(DELOTET_STATUS_UNSUPPORTED, delotet_voronoi_new(other, NULL, &voronoi, &error));
    CHECK(voronoi == NULL);
    OK(delotet_options_set_cancel_token(options, token, &error));
    delotet_cancel_token_cancel(token);
    FAILS(DELOTET_STATUS_CANCELLED, delotet_voronoi_new(mesh, options, &voronoi, &error));
    FAILS(INVALID, delotet_voronoi_new(NULL, NULL, &voronoi, &error));
    FAILS(INVALID, delotet_voronoi_new(mesh, NULL, NULL, &error));
    CHECK(voronoi == NULL);
    delotet_cancel_token_free(token);
    delotet_options_free(options);
    delotet_mesh_free(other);
    delotet_mesh_free(mesh);
    delotet_plc_free(plc);
    return 0;
}
