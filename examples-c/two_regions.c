/* Two materials: a box of length 3 with a wall at x = 1, markers on its sides, and the faces of the interface. */
#include <delotet/delotet.h>
#include <math.h>
#include <stdio.h>

enum { LEFT = 1, RIGHT = 2, SIDES = 3, INTERFACE = 4 };

/* Ends the program and prints everything known about a failure. */
static int fail(DelotetStatus status, DelotetError *error)
{
    fprintf(stderr, "%s: %s\n", delotet_status_name(status), delotet_error_message(error));
    delotet_error_free(error);
    return 1;
}

static double volume(const double *xyz, const uint32_t *tet)
{
    double e[3][3];
    int i, axis;
    for (i = 0; i < 3; i++)
        for (axis = 0; axis < 3; axis++)
            e[i][axis] = xyz[3 * tet[i + 1] + axis] - xyz[3 * tet[0] + axis];
    return (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
            e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) / 6;
}

static double area(const double *xyz, const uint32_t *corners)
{
    double u[3], v[3];
    int axis;
    for (axis = 0; axis < 3; axis++) {
        u[axis] = xyz[3 * corners[1] + axis] - xyz[3 * corners[0] + axis];
        v[axis] = xyz[3 * corners[2] + axis] - xyz[3 * corners[0] + axis];
    }
    return sqrt(pow(u[1] * v[2] - u[2] * v[1], 2) + pow(u[2] * v[0] - u[0] * v[2], 2) +
                pow(u[0] * v[1] - u[1] * v[0], 2)) / 2;
}

int main(void)
{
    /* Points 4 i to 4 i + 3: the square at x = 0, 1 and 3. */
    const double xyz[] = {0, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0,
                          1, 1, 1, 1, 0, 1, 3, 0, 0, 3, 1, 0, 3, 1, 1, 3, 0, 1};
    const uint32_t squares[] = {0, 1, 2, 3, 8, 9, 10, 11, 4, 5, 6, 7,               /* ends and wall */
                                0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7,     /* sides of the left part */
                                4, 5, 9, 8, 5, 6, 10, 9, 6, 7, 11, 10, 7, 4, 8, 11}; /* and of the right part */
    const size_t ends[] = {4, 8, 12, 16, 20, 24, 28, 32, 36, 40, 44};
    const int32_t markers[] = {LEFT, RIGHT, INTERFACE, SIDES, SIDES, SIDES, SIDES, SIDES, SIDES, SIDES, SIDES};
    const double left[] = {0.5, 0.5, 0.5}, right[] = {2, 0.5, 0.5};
    double volumes[2] = {0, 0}, interface_area = 0;
    DelotetPlc *plc = NULL;
    DelotetMesh *mesh = NULL;
    DelotetError *error = NULL;
    DelotetDoublesView materials;
    DelotetStatus status;
    size_t i;

    if ((status = delotet_plc_new(xyz, 12, &plc, &error)) ||
        (status = delotet_plc_add_polygons(plc, squares, ends, markers, 11, &error)) ||
        (status = delotet_plc_add_region(plc, left, 10, 0, &error)) ||
        (status = delotet_plc_add_region(plc, right, 20, 0, &error)) ||
        (status = delotet_tetrahedralize(plc, NULL, &mesh, &error)) ||
        (status = delotet_mesh_tet_attributes(mesh, &materials, &error)))
        return fail(status, error);

    const double *points = delotet_mesh_points(mesh).data;
    const uint32_t *tets = delotet_mesh_tets(mesh).data;
    for (i = 0; i < materials.count; i++)
        volumes[materials.data[i] == 20] += volume(points, tets + 4 * i);
    DelotetSubfacesView faces = delotet_mesh_subfaces(mesh);
    for (i = 0; i < faces.count; i++) {
        const DelotetSubface *face = DELOTET_AT(DelotetSubface, faces, i);
        if (face->marker == INTERFACE) {
            /* An interface has a tetrahedron of either material behind it. */
            if (materials.data[face->tets[0]] == materials.data[face->tets[1]])
                return 1;
            interface_area += area(points, face->corners);
        }
    }
    printf("material 10: volume %g\nmaterial 20: volume %g\ninterface: area %g\n", volumes[0], volumes[1], interface_area);
    delotet_mesh_free(mesh);
    delotet_plc_free(plc);
    return 0;
}
