/* delotet_mesh_quality: known shapes, volumes that add up, and extreme sizes. */
#include "test.h"

static DelotetMesh *single(const double *xyz)
{
    static const uint32_t corners[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    DelotetPlc *plc = NULL;
    OK(delotet_plc_new(xyz, 4, &plc, &error));
    OK(delotet_plc_add_triangles(plc, corners, NULL, 4, &error));
    return mesh_of(plc);
}

int main(void)
{
    static const double regular[12] = {1, 1, 1, -1, 1, -1, 1, -1, -1, -1, -1, 1};
    static const double scales[5] = {1, 1e-100, 1e100, 1e-60, 1e90};
    DelotetTetQualitiesView view, again;
    const DelotetTetQuality *quality;
    DelotetMesh *mesh;
    double xyz[12], sum = 0;
    size_t i, k;
    for (i = 0; i < 5; i++) {
        for (k = 0; k < 12; k++)
            xyz[k] = scales[i] * regular[k];
        mesh = single(xyz);
        OK(delotet_mesh_quality(mesh, &view, &error));
        CHECK(view.count == 1 && view.stride == sizeof *quality);
        quality = DELOTET_AT(DelotetTetQuality, view, 0);
        for (k = 0; k < 6; k++)
            CHECK(fabs(quality->dihedrals[k] - 70.528779365509308) < 1e-10);
        CHECK(fabs(quality->radius_edge - 0.61237243569579452) < 1e-12);
        CHECK(fabs(quality->eta - 1) < 1e-12);
        CHECK(near(quality->volume / scales[i] / scales[i] / scales[i], 8.0 / 3));
        delotet_mesh_free(mesh);
    }
    mesh = mesh_of(nested_boxes());
    OK(delotet_mesh_quality(mesh, &view, &error));
    CHECK(view.count == delotet_mesh_tets(mesh).count);
    for (i = 0; i < view.count; i++) {
        quality = DELOTET_AT(DelotetTetQuality, view, i);
        CHECK(near(quality->volume, volume_of(delotet_mesh_points(mesh).data, delotet_mesh_tets(mesh).data + 4 * i)));
        CHECK(quality->eta > 0 && quality->eta < 1 && quality->radius_edge > 0.61);
        sum += quality->volume;
    }
    CHECK(near(sum, 27));
    OK(delotet_mesh_quality(mesh, &again, &error));
    CHECK(again.first == view.first);
    FAILS(INVALID, delotet_mesh_quality(NULL, &view, &error));
    FAILS(INVALID, delotet_mesh_quality(mesh, NULL, &error));
    delotet_mesh_free(mesh);
    return 0;
}
