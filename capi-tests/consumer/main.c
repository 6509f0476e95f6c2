/* What a user's program does: a cube, and the version. */
#include <delotet/delotet.h>
#include <stdio.h>

int main(void)
{
    static const double xyz[24] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1};
    static const uint32_t corners[24] = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
    static const size_t ends[6] = {4, 8, 12, 16, 20, 24};
    DelotetPlc *plc = NULL;
    DelotetMesh *mesh = NULL;
    DelotetError *error = NULL;
    int ok = delotet_version() == DELOTET_VERSION && delotet_plc_new(xyz, 8, &plc, &error) == DELOTET_STATUS_OK &&
             delotet_plc_add_polygons(plc, corners, ends, NULL, 6, &error) == DELOTET_STATUS_OK &&
             delotet_tetrahedralize(plc, NULL, &mesh, &error) == DELOTET_STATUS_OK;
    printf("delotet %s: %s, %zu tetrahedra\n", delotet_version_string(), ok ? "ok" : delotet_error_message(error),
           delotet_mesh_tets(mesh).count);
    ok = ok && delotet_mesh_tets(mesh).count >= 5;
    delotet_mesh_free(mesh);
    delotet_plc_free(plc);
    delotet_error_free(error);
    return !ok;
}
