// Delaunay tetrahedralizations compared with CGAL's and TetGen's: the same count if points are in general position, always the same volume,
// and empty circumspheres by CGAL's exact predicates.
#include "peers.hpp"

#include <cmath>
#include <cstdio>
#include <delotet/delotet.hpp>
#include <functional>
#include <random>

struct Set {
    const char *name;
    bool general; ///< No five points on a sphere, as far as random numbers go: the tetrahedralization is unique.
    std::function<std::vector<Point>()> make;
};

static std::mt19937_64 engine(12345);

static double uniform()
{
    return static_cast<double>(engine() >> 11) * 0x1p-53;
}

static std::vector<Point> points(std::size_t count, const std::function<Point(std::size_t)> &make)
{
    std::vector<Point> list(count);
    for (std::size_t i = 0; i < count; i++)
        list[i] = make(i);
    return list;
}

static Point on_sphere()
{
    for (;;) {
        const Point p = {2 * uniform() - 1, 2 * uniform() - 1, 2 * uniform() - 1};
        const double r = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
        if (r > 0.1 && r < 1)
            return {p[0] / r, p[1] / r, p[2] / r};
    }
}

static Point whole(std::size_t i, std::size_t n)
{
    return {static_cast<double>(i % n), static_cast<double>(i / n % n), static_cast<double>(i / n / n)};
}

static Result ours(const std::vector<Point> &list)
{
    Result result;
    const Stopwatch watch;
    const delotet::Plc plc(list);
    delotet::Options options;
    options.mode(delotet::Mode::delaunay);
    const delotet::Mesh mesh = delotet::tetrahedralize(plc, options);
    result.seconds = watch.seconds();
    result.points.assign(mesh.points().begin(), mesh.points().end());
    result.tets.assign(mesh.tets().begin(), mesh.tets().end());
    return result;
}

int main()
{
    const Set sets[] = {
        {"random", true, [] { return points(50000, [](std::size_t) { return Point{uniform(), uniform(), uniform()}; }); }},
        {"clustered", true,
         [] {
             return points(20000, [](std::size_t i) {
                 const Point p = on_sphere();
                 const double r = std::pow(uniform(), 6) * 1e-3;
                 const double c = static_cast<double>(i % 10);
                 return Point{c * 0.7 + p[0] * r, c * c * 0.13 + p[1] * r, std::sin(c) + p[2] * r};
             });
         }},
        {"sphere, rounded", true, [] { return points(20000, [](std::size_t) { return on_sphere(); }); }},
        {"saddle", true,
         [] {
             return points(10000, [](std::size_t) {
                 const double x = uniform(), y = uniform();
                 return Point{x, y, x * x - y * y + 1e-3 * uniform()};
             });
         }},
        {"grid", false, [] { return points(27000, [](std::size_t i) { return whole(i, 30); }); }},
        {"grid, repeated", false, [] { return points(16000, [](std::size_t i) { return whole(i / 2, 20); }); }},
        {"two planes", false,
         [] { return points(8000, [](std::size_t i) { Point p = whole(i % 4000, 64); p[2] = i < 4000 ? 0 : 1; return p; }); }},
        {"circle and axis", false,
         [] {
             return points(600, [](std::size_t i) {
                 const double a = static_cast<double>(i) * 0.010471975511965978;
                 return i % 2 ? Point{0, 0, static_cast<double>(i)} : Point{std::cos(a), std::sin(a), 0};
             });
         }},
    };
    std::printf("%-16s %8s | %10s %7s | %10s %7s | %10s %7s\n", "points", "count", "delotet", "s", "CGAL", "s",
                "TetGen", "s");
    int failures = 0;
    for (const Set &set : sets) {
        const std::vector<Point> list = set.make();
        const Result a = ours(list), b = cgal_delaunay(list), c = tetgen(list, {}, 60);
        std::printf("%-16s %8zu | %10zu %7.3f | %10zu %7.3f | ", set.name, list.size(), a.tets.size(), a.seconds,
                    b.tets.size(), b.seconds);
        if (c.ok())
            std::printf("%10zu %7.3f\n", c.tets.size(), c.seconds);
        else
            std::printf("%10s\n", c.outcome.c_str());
        const auto expect = [&](bool condition, const char *what) {
            if (!condition) {
                std::printf("  FAILED: %s\n", what);
                failures++;
            }
        };
        expect(not_positive(a) == 0, "every tetrahedron is positive");
        expect(not_delaunay(a) == 0, "every circumsphere is empty");
        expect(exact_volume(a.points, a.tets) == exact_volume(b.points, b.tets), "the volume is CGAL's, exactly");
        if (set.general) {
            expect(a.tets.size() == b.tets.size(), "the count is CGAL's");
            // TetGen calls points closer than its tolerance equal: then its count is of other points.
            if (c.ok() && not_delaunay(c) == 0 && rounded_volume(c.points, c.tets) == rounded_volume(a.points, a.tets))
                expect(a.tets.size() == c.tets.size(), "the count is TetGen's");
        }
        if (c.ok())
            expect(std::fabs(rounded_volume(c.points, c.tets) / rounded_volume(a.points, a.tets) - 1) < 1e-9,
                   "the volume is TetGen's");
    }
    return failures != 0;
}
