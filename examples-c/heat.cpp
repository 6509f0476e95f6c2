// Heat in two materials with a size per region: a slab 0 < x < 1 of conductivity 1 and a slab 1 < x < 2 of conductivity 10, temperature 0
// at x = 0 and 1 at x = 2, the sides insulated. The steady temperature is linear in each slab. The interface is made of faces of the mesh,
// so linear elements reproduce the solution however fine either side is: heat [<mesh.ele> <values.txt>].
#include "elements.hpp"
#include "values.hpp"

#include <array>
#include <cstdio>
#include <map>

enum : delotet::Marker { cold = 1, hot = 2, insulated = 3, between = 4 };

/// Of material 1 and 2, which are also the attributes of the regions.
static const double conductivity[] = {1, 10}, size[] = {0.25, 0.12};

/// Temperature, with the flux q = 1 / (1 / 1 + 1 / 10) everywhere.
static double solution(const delotet::Point &p)
{
    const double flux = 1 / (1 / conductivity[0] + 1 / conductivity[1]);
    return p[0] < 1 ? flux / conductivity[0] * p[0] : 1 - flux / conductivity[1] * (2 - p[0]);
}

/// Surface and interface as squares of edge 1/n, two triangles each.
static delotet::Plc slabs(int n)
{
    std::vector<delotet::Point> points;
    std::map<std::array<int, 3>, delotet::Index> index;
    std::vector<delotet::Index> corners;
    std::vector<delotet::Marker> markers;
    const std::array<int, 3> squares = {2 * n, n, n};
    // All squares normal to an axis at a position on it.
    const auto plane = [&](std::size_t axis, int position, delotet::Marker marker) {
        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (int a = 0; a < squares[u]; a++)
            for (int b = 0; b < squares[v]; b++) {
                const auto corner = [&](int da, int db) {
                    std::array<int, 3> at{};
                    at[axis] = position;
                    at[u] = a + da;
                    at[v] = b + db;
                    const auto added = index.emplace(at, static_cast<delotet::Index>(points.size()));
                    if (added.second)
                        points.push_back({double(at[0]) / n, double(at[1]) / n, double(at[2]) / n});
                    return added.first->second;
                };
                for (const auto c : {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 0), corner(1, 1), corner(0, 1)})
                    corners.push_back(c);
                markers.insert(markers.end(), 2, marker);
            }
    };
    plane(0, 0, cold);
    plane(0, n, between);
    plane(0, 2 * n, hot);
    for (std::size_t axis = 1; axis < 3; axis++) {
        plane(axis, 0, insulated);
        plane(axis, n, insulated);
    }
    delotet::Plc plc(points);
    plc.add_triangles(corners, markers);
    for (int material = 1; material <= 2; material++)
        plc.add_region({material - 0.5, 0.5, 0.5}, material).set_region_size(material, size[material - 1]);
    return plc;
}

int main(int argc, char **argv)
{
    const delotet::Plc plc = slabs(4);
    const delotet::Mesh mesh =
        delotet::tetrahedralize(plc, delotet::Options().mode(delotet::Mode::preserve).quality(2).optimize(1));
    const auto points = mesh.points();
    const auto tets = mesh.tets();
    const auto materials = mesh.tet_attributes();

    // The ends have known temperatures. Insulated sides need nothing.
    std::vector<double> fixed(points.size(), unknown);
    for (const delotet::Subface &face : mesh.subfaces())
        if (face.marker == cold || face.marker == hot)
            for (const delotet::Index corner : face.corners)
                fixed[corner] = face.marker == hot;
    const auto of_tet = [&](std::size_t t) { return conductivity[materials[t] == 2]; };
    const Solution found = solve(mesh, fixed, of_tet, [](const delotet::Point &) { return 0.0; }, 1e-12);
    if (argc > 2) {
        mesh.write(plc, argv[1]);
        write_values(argv[2], found.u);
    }
    double error = 0;
    for (std::size_t i = 0; i < points.size(); i++)
        error = std::fmax(error, std::fabs(found.u[i] - solution(points[i])));

    std::size_t number[2] = {0, 0};
    double volumes[2] = {0, 0}, edges[2] = {0, 0};
    for (std::size_t t = 0; t < tets.size(); t++) {
        const Element element(mesh, tets[t]);
        const int slab = materials[t] == 2;
        for (int i = 0; i < 4; i++)
            for (int j = 0; j < i; j++)
                edges[slab] += (element.vertices.row(i) - element.vertices.row(j)).norm() / 6;
        number[slab]++;
        volumes[slab] += element.volume;
    }

    std::printf("%zu points, smallest dihedral angle %.1f degrees\n", points.size(),
                mesh.quality_summary().worst[DELOTET_QUALITY_MIN_DIHEDRAL]);
    for (int slab = 0; slab < 2; slab++) {
        edges[slab] /= number[slab];
        std::printf("material %d: %zu tetrahedra, volume %g, mean edge %.3f for size %g\n", slab + 1, number[slab],
                    volumes[slab], edges[slab], size[slab]);
    }
    std::printf("%d iterations, largest error %.1e\n", found.iterations, error);
    const bool finer = edges[1] < 0.8 * edges[0] && number[1] > 2 * number[0];
    const bool filled = std::fabs(volumes[0] - 1) < 1e-12 && std::fabs(volumes[1] - 1) < 1e-12;
    const bool good = found.found && error < 1e-6 && finer && filled;
    std::printf(good ? "the temperature is exact, material 2 is finer\n" : "the result is wrong\n");
    return !good;
}
