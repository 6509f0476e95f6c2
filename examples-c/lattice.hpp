// A box of nx × ny × nz cubes as input for the solvers: its surface as triangles with a marker per side, and points inside (the
// corners and the centres of the cubes: a body-centred lattice, whose Delaunay tetrahedra are well shaped).
#ifndef EXAMPLES_LATTICE_HPP
#define EXAMPLES_LATTICE_HPP
#include <delotet/delotet.hpp>

#include <array>
#include <map>
#include <vector>

/// Markers of the sides.
enum Side : delotet::Marker { x_low = 1, x_high = 2, y_low = 3, y_high = 4, z_low = 5, z_high = 6 };

inline delotet::Plc lattice(std::array<int, 3> cubes, double edge)
{
    std::vector<delotet::Point> points;
    std::map<std::array<int, 3>, delotet::Index> index;
    for (int i = 0; i <= cubes[0]; i++)
        for (int j = 0; j <= cubes[1]; j++)
            for (int k = 0; k <= cubes[2]; k++) {
                index[{i, j, k}] = static_cast<delotet::Index>(points.size());
                points.push_back({i * edge, j * edge, k * edge});
            }
    for (int i = 0; i < cubes[0]; i++)
        for (int j = 0; j < cubes[1]; j++)
            for (int k = 0; k < cubes[2]; k++)
                points.push_back({(i + 0.5) * edge, (j + 0.5) * edge, (k + 0.5) * edge});

    std::vector<delotet::Index> corners;
    std::vector<delotet::Marker> markers;
    for (std::size_t axis = 0; axis < 3; axis++) {
        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (int side = 0; side < 2; side++)
            for (int a = 0; a < cubes[u]; a++)
                for (int b = 0; b < cubes[v]; b++) {
                    const auto corner = [&](int da, int db) {
                        std::array<int, 3> at{};
                        at[axis] = side * cubes[axis];
                        at[u] = a + da;
                        at[v] = b + db;
                        return index.at(at);
                    };
                    for (const auto c : {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 0), corner(1, 1), corner(0, 1)})
                        corners.push_back(c);
                    for (int half = 0; half < 2; half++)
                        markers.push_back(static_cast<delotet::Marker>(2 * axis + 1) + side);
                }
    }
    delotet::Plc plc(points);
    plc.add_triangles(corners, markers);
    return plc;
}
#endif
