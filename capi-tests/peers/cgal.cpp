// CGAL: its Delaunay tetrahedralization, its exact predicates, and exact sums.
#include "peers.hpp"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Gmpq.h>
#include <CGAL/Gmpzf.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <algorithm>
#include <sstream>
#include <unordered_map>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Exact = CGAL::Gmpzf;

static Kernel::Point_3 point(const Point &p)
{
    return {p[0], p[1], p[2]};
}

Result cgal_delaunay(const std::vector<Point> &points)
{
    using Vertex = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>;
    using Cell = CGAL::Delaunay_triangulation_cell_base_3<Kernel>;
    using Delaunay = CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<Vertex, Cell>>;
    std::vector<std::pair<Kernel::Point_3, std::uint32_t>> input;
    for (std::uint32_t i = 0; i < points.size(); i++)
        input.emplace_back(point(points[i]), i);
    Result result;
    const Stopwatch watch;
    const Delaunay delaunay(input.begin(), input.end());
    result.seconds = watch.seconds();
    result.points = points;
    for (const auto &cell : delaunay.finite_cell_handles())
        result.tets.push_back({cell->vertex(0)->info(), cell->vertex(1)->info(), cell->vertex(2)->info(),
                               cell->vertex(3)->info()});
    return result;
}

Result cgal_regular(const std::vector<Point> &points, const std::vector<double> &weights)
{
    using Base = CGAL::Regular_triangulation_vertex_base_3<Kernel>;
    using Vertex = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel, Base>;
    using Cell = CGAL::Regular_triangulation_cell_base_3<Kernel>;
    using Regular = CGAL::Regular_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<Vertex, Cell>>;
    std::vector<std::pair<Kernel::Weighted_point_3, std::uint32_t>> input;
    for (std::uint32_t i = 0; i < points.size(); i++)
        input.emplace_back(Kernel::Weighted_point_3(point(points[i]), weights[i]), i);
    Result result;
    const Stopwatch watch;
    const Regular regular(input.begin(), input.end());
    result.seconds = watch.seconds();
    result.points = points;
    for (const auto &cell : regular.finite_cell_handles())
        result.tets.push_back({cell->vertex(0)->info(), cell->vertex(1)->info(), cell->vertex(2)->info(),
                               cell->vertex(3)->info()});
    return result;
}

bool coplanar(const Point &a, const Point &b, const Point &c, const Point &d)
{
    return CGAL::orientation(point(a), point(b), point(c), point(d)) == CGAL::ZERO;
}

std::size_t not_positive(const Result &mesh)
{
    return static_cast<std::size_t>(std::count_if(mesh.tets.begin(), mesh.tets.end(), [&](const Tet &tet) {
        return CGAL::orientation(point(mesh.points[tet[0]]), point(mesh.points[tet[1]]), point(mesh.points[tet[2]]),
                                 point(mesh.points[tet[3]])) != CGAL::POSITIVE;
    }));
}

static Triangle sorted(Triangle face)
{
    std::sort(face.begin(), face.end());
    return face;
}

struct Hash {
    std::size_t operator()(const Triangle &face) const
    {
        std::size_t hash = 0;
        for (const std::uint32_t corner : face)
            hash = (hash ^ corner) * 0x9E3779B97F4A7C15u;
        return hash ^ (hash >> 29);
    }
};

std::size_t not_delaunay(const Result &mesh)
{
    // Per face the tetrahedron that had it first; constraints are marked and never tested.
    constexpr std::uint32_t constrained = UINT32_MAX;
    std::unordered_map<Triangle, std::uint32_t, Hash> first;
    first.reserve(2 * mesh.tets.size() + mesh.constraints.size());
    for (const Triangle &face : mesh.constraints)
        first[sorted(face)] = constrained;
    std::size_t count = 0;
    for (std::uint32_t t = 0; t < mesh.tets.size(); t++)
        for (std::size_t side = 0; side < 4; side++) {
            const Tet &tet = mesh.tets[t];
            const Triangle face = sorted({tet[(side + 1) % 4], tet[(side + 2) % 4], tet[(side + 3) % 4]});
            const auto [entry, is_new] = first.emplace(face, t);
            if (is_new || entry->second == constrained)
                continue;
            const Tet &other = mesh.tets[entry->second];
            const auto a = point(mesh.points[other[0]]), b = point(mesh.points[other[1]]),
                       c = point(mesh.points[other[2]]), d = point(mesh.points[other[3]]);
            // Flat tetrahedra have no circumsphere; not_positive counts them.
            if (CGAL::orientation(a, b, c, d) == CGAL::POSITIVE &&
                CGAL::side_of_oriented_sphere(a, b, c, d, point(mesh.points[tet[side]])) == CGAL::ON_POSITIVE_SIDE)
                count++;
        }
    return count;
}

/// Exactly det(b − a, c − a, d − a).
static Exact determinant(const Point &a, const Point &b, const Point &c, const Point &d)
{
    Exact e[3][3];
    const Point *ends[3] = {&b, &c, &d};
    for (std::size_t i = 0; i < 3; i++)
        for (std::size_t axis = 0; axis < 3; axis++)
            e[i][axis] = Exact((*ends[i])[axis]) - Exact(a[axis]);
    return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
           e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

static Exact sum(const std::vector<Point> &points, const std::vector<Tet> &tets)
{
    Exact total(0);
    for (const Tet &tet : tets)
        total += determinant(points[tet[0]], points[tet[1]], points[tet[2]], points[tet[3]]);
    return total;
}

static Exact sum(const std::vector<Point> &points, const std::vector<Triangle> &triangles)
{
    const Point origin = {0, 0, 0};
    Exact total(0);
    for (const Triangle &t : triangles)
        total += determinant(origin, points[t[0]], points[t[1]], points[t[2]]);
    return total;
}

/// The rational number that an exact sum is: equal numbers have equal texts.
static std::string text(const Exact &value)
{
    std::ostringstream out;
    const double head = CGAL::to_double(value);
    out << std::hexfloat << head;
    // What the double leaves over, and so on until nothing is left.
    Exact rest = value - Exact(head);
    while (CGAL::sign(rest) != CGAL::ZERO) {
        const double next = CGAL::to_double(rest);
        if (next == 0)
            break;
        out << "," << next;
        rest = rest - Exact(next);
    }
    return out.str();
}

std::string exact_volume(const std::vector<Point> &points, const std::vector<Tet> &tets)
{
    return text(sum(points, tets));
}
std::string exact_volume(const std::vector<Point> &points, const std::vector<Triangle> &triangles)
{
    return text(sum(points, triangles));
}
double rounded_volume(const std::vector<Point> &points, const std::vector<Tet> &tets)
{
    return CGAL::to_double(sum(points, tets)) / 6;
}
double rounded_volume(const std::vector<Point> &points, const std::vector<Triangle> &triangles)
{
    return CGAL::to_double(sum(points, triangles)) / 6;
}
