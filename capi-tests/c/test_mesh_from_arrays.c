/* delotet_mesh_from_arrays: orientation, attributes, kept faces and edges; every error with the elements at fault. */
#include "test.h"

static const double XYZ[18] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1, 5, 5, 5};
/* The second one is negative. */
static const uint32_t TETS[8] = {0, 1, 2, 3, 1, 2, 3, 4};

#define MAKE(xyz, points, inputs, tets, count, attributes, options)                                                   \
    delotet_mesh_from_arrays(xyz, points, inputs, tets, count, attributes, NULL, 0, NULL, NULL, 0, NULL, options, &mesh, \
                             &error)

static DelotetDefect defect_of(const double *xyz, const uint32_t *tets, size_t count, DelotetStatus expected)
{
    DelotetError *error = NULL;
    DelotetMesh *mesh = NULL;
    DelotetDefect defect;
    CHECK(MAKE(xyz, 6, 6, tets, count, NULL, NULL) == expected && mesh == NULL);
    CHECK(delotet_error_defects(error).count == 1);
    defect = *DELOTET_AT(DelotetDefect, delotet_error_defects(error), 0);
    delotet_error_free(error);
    return defect;
}

int main(void)
{
    static const double attributes[2] = {3, 2};
    static const uint32_t faces[6] = {2, 1, 0, 1, 3, 0}, edges[2] = {3, 1}, no_face[3] = {0, 1, 4}, no_edge[2] = {0, 4};
    static const int32_t face_markers[2] = {7, -8}, edge_markers[1] = {9};
    static const uint32_t flat[4] = {0, 1, 2, 2}, far[4] = {0, 1, 2, 6}, twice[8] = {0, 1, 2, 3, 0, 1, 2, 3};
    double bad[18];
    DelotetMesh *mesh = NULL;
    DelotetOptions *options = delotet_options_new();
    DelotetCancelToken *token = delotet_cancel_token_new();
    DelotetDefect defect;
    const DelotetSubface *face;
    size_t i, outer = 0;

    OK(delotet_mesh_from_arrays(XYZ, 6, 6, TETS, 2, attributes, faces, 2, face_markers, edges, 1, edge_markers, NULL,
                                &mesh, &error));
    CHECK(delotet_mesh_tets(mesh).count == 2 && near(volume(mesh), 0.5));
    CHECK(delotet_mesh_input_point_count(mesh) == 6 && delotet_mesh_points(mesh).count == 6);
    CHECK(delotet_mesh_unmeshed_points(mesh).count == 1 && delotet_mesh_unmeshed_points(mesh).data[0] == 5);
    CHECK(delotet_mesh_regions(mesh).count == 2);
    CHECK(DELOTET_AT(DelotetRegion, delotet_mesh_regions(mesh), 0)->attribute == 2);
    CHECK(delotet_mesh_neighbors(mesh).data[0] == 1);
    /* Six faces of the boundary, and the one between the attributes. */
    CHECK(delotet_mesh_subfaces(mesh).count == 7);
    for (i = 0; i < 7; i++) {
        face = DELOTET_AT(DelotetSubface, delotet_mesh_subfaces(mesh), i);
        CHECK(face->facet == i && face->marker == (i == 0 ? 7 : i == 1 ? -8 : 0));
        outer += face->tets[1] == DELOTET_INVALID_INDEX;
    }
    CHECK(outer == 6 && delotet_mesh_subsegments(mesh).count == 1);
    CHECK(DELOTET_AT(DelotetSubsegment, delotet_mesh_subsegments(mesh), 0)->marker == 9);
    delotet_mesh_free(mesh);

    /* Points behind the last one on the boundary are none of the input. */
    OK(MAKE(XYZ, 6, 0, TETS, 2, NULL, options));
    CHECK(delotet_mesh_input_point_count(mesh) == 5 && delotet_mesh_steiner_points(mesh).count == 1);
    CHECK(delotet_mesh_subfaces(mesh).count == 6 && delotet_mesh_regions(mesh).count == 1);
    delotet_mesh_free(mesh);

    defect = defect_of(XYZ, flat, 1, DELOTET_STATUS_CHECK_FAILED);
    CHECK(defect.kind == DELOTET_DEFECT_KIND_NOT_POSITIVE && defect.first == 0);
    defect = defect_of(XYZ, far, 1, DELOTET_STATUS_INDEX_OUT_OF_RANGE);
    CHECK(defect.kind == DELOTET_DEFECT_KIND_INDEX_OUT_OF_RANGE && defect.second == 6);
    memcpy(bad, XYZ, sizeof bad);
    bad[4] = NAN;
    defect = defect_of(bad, TETS, 2, DELOTET_STATUS_NON_FINITE_POINT);
    CHECK(defect.kind == DELOTET_DEFECT_KIND_NON_FINITE && defect.first == 1);
    FAILS(DELOTET_STATUS_CHECK_FAILED, MAKE(XYZ, 6, 6, twice, 2, NULL, NULL));
    bad[4] = 1e300;
    bad[5] = 1e-300;
    FAILS(DELOTET_STATUS_COORDINATE_RANGE, MAKE(bad, 6, 6, TETS, 2, NULL, NULL));
    FAILS(DELOTET_STATUS_CHECK_FAILED, delotet_mesh_from_arrays(XYZ, 6, 6, TETS, 2, NULL, no_face, 1, NULL, NULL, 0, NULL,
                                                                NULL, &mesh, &error));
    FAILS(DELOTET_STATUS_CHECK_FAILED, delotet_mesh_from_arrays(XYZ, 6, 6, TETS, 2, NULL, NULL, 0, NULL, no_edge, 1, NULL,
                                                                NULL, &mesh, &error));
    bad[0] = NAN;
    FAILS(INVALID, MAKE(XYZ, 6, 6, TETS, 2, bad, NULL));
    FAILS(INVALID, MAKE(XYZ, 6, 6, TETS, 0, NULL, NULL));
    FAILS(INVALID, MAKE(XYZ, 6, 7, TETS, 2, NULL, NULL));
    FAILS(INVALID, MAKE(NULL, 6, 6, TETS, 2, NULL, NULL));
    FAILS(INVALID, MAKE(XYZ, 6, 6, NULL, 2, NULL, NULL));
    FAILS(INVALID, MAKE(XYZ, SIZE_MAX / 8, 6, TETS, 2, NULL, NULL));
    FAILS(INVALID, delotet_mesh_from_arrays(XYZ, 6, 6, TETS, 2, NULL, NULL, 1, NULL, NULL, 0, NULL, NULL, &mesh, &error));
    FAILS(INVALID, delotet_mesh_from_arrays(XYZ, 6, 6, TETS, 2, NULL, NULL, 0, NULL, NULL, 1, NULL, NULL, &mesh, &error));
    FAILS(INVALID, delotet_mesh_from_arrays(XYZ, 6, 6, TETS, 2, NULL, NULL, 0, NULL, NULL, 0, NULL, NULL, NULL, &error));
    OK(delotet_options_set_cancel_token(options, token, &error));
    delotet_cancel_token_cancel(token);
    FAILS(DELOTET_STATUS_CANCELLED, MAKE(XYZ, 6, 6, TETS, 2, NULL, options));
    CHECK(mesh == NULL);
    delotet_options_free(options);
    delotet_cancel_token_free(token);
    return 0;
}
