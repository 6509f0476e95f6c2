// What the C++ tests share.
#ifndef DELOTET_TEST_HPP
#define DELOTET_TEST_HPP
#include <delotet/delotet.hpp>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#define CHECK(...)                                                                              \
    do {                                                                                        \
        if (!(__VA_ARGS__)) {                                                                   \
            std::fprintf(stderr, "%s:%d: failed: %s\n", __FILE__, __LINE__, #__VA_ARGS__);      \
            std::exit(1);                                                                       \
        }                                                                                       \
    } while (0)

using delotet::Index;
using delotet::Marker;
using delotet::Point;

/// Corner i has x high if bit 0 of i is set, y for bit 1, z for bit 2.
inline std::vector<Point> box_points(double low, double high)
{
    std::vector<Point> points;
    for (unsigned i = 0; i < 8; i++)
        points.push_back({i & 1 ? high : low, i & 2 ? high : low, i & 4 ? high : low});
    return points;
}

/// Twelve triangles of a box, looking outward.
inline std::vector<Index> box_corners(Index first = 0)
{
    std::vector<Index> corners = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                  2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    for (Index &corner : corners)
        corner += first;
    return corners;
}

/// Points in the unit cube, the same in every run.
inline std::vector<Point> random_points(std::size_t count, std::uint64_t seed = 1)
{
    std::vector<Point> points(count);
    for (Point &point : points)
        for (double &x : point) {
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            x = static_cast<double>(seed >> 11) / 9007199254740992.0;
        }
    return points;
}

inline double volume(const delotet::Mesh &mesh)
{
    double sum = 0;
    for (const delotet::Tet &tet : mesh.tets()) {
        std::array<std::array<double, 3>, 3> e;
        for (std::size_t i = 0; i < 3; i++)
            for (std::size_t axis = 0; axis < 3; axis++)
                e[i][axis] = mesh.points()[tet[i + 1]][axis] - mesh.points()[tet[0]][axis];
        const double six = e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
                           e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                           e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
        CHECK(six > 0);
        sum += six / 6;
    }
    return sum;
}

#if DELOTET_EXCEPTIONS
inline delotet::Plc cube()
{
    delotet::Plc plc(box_points(0, 1));
    plc.add_triangles(box_corners());
    return plc;
}

/// A box from 0 to 3 (marker 7) around a box from 1 to 2 (marker 8).
inline delotet::Plc nested_boxes()
{
    std::vector<Point> points = box_points(0, 3);
    for (const Point &point : box_points(1, 2))
        points.push_back(point);
    delotet::Plc plc(points);
    plc.add_triangles(box_corners(), std::vector<Marker>(12, 7)).add_triangles(box_corners(8), std::vector<Marker>(12, 8));
    return plc;
}

/// Schoenhardt's polyhedron: no tetrahedralization without Steiner points.
inline delotet::Plc twisted_prism()
{
    const double xyz[] = {0, 0, 0, 4, 0, 0, 2, 3, 0, 1, -1, 4, 4, 1.5, 4, 0.5, 2.5, 4};
    const Index corners[] = {0, 2, 1, 3, 4, 5, 0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 2, 0, 3, 2, 3, 5};
    delotet::Plc plc(xyz);
    plc.add_triangles(corners);
    return plc;
}

/// A tetrahedron and a triangle that pierces its side z = 0.
inline delotet::Plc pierced()
{
    const double xyz[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4, 1, 1, -1, 1.5, 1, -1, 1, 1, 0.75};
    const Index corners[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3, 4, 5, 6};
    delotet::Plc plc(xyz);
    plc.add_triangles(corners);
    return plc;
}

template <class E, class Call> E caught(Call &&call)
{
    try {
        call();
    } catch (const E &e) {
        return e;
    }
    std::fprintf(stderr, "nothing was thrown\n");
    std::exit(1);
}
#endif
#endif
