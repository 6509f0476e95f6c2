// Weighted Delaunay tetrahedralizations and power diagrams compared with CGAL's regular triangulation and TetGen's -w -v: on random sets
// the same tetrahedra as CGAL, and the centres of TetGen where its tetrahedra are as many.
#include "peers.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <delotet/delotet.hpp>
#include <functional>
#include <random>

struct Set {
    const char *name;
    std::size_t count;
    double spread; ///< Weights are from 0 to this; 0: none.
};

static std::mt19937_64 engine(54321);

static double uniform()
{
    return static_cast<double>(engine() >> 11) * 0x1p-53;
}

static std::vector<Tet> sorted(std::vector<Tet> tets)
{
    for (Tet &tet : tets)
        std::sort(tet.begin(), tet.end());
    std::sort(tets.begin(), tets.end());
    return tets;
}

/// The largest distance of a centre from the one at the same place of the other list, both sorted by x; relative to the size of centres.
static double farthest(std::vector<Point> a, std::vector<Point> b)
{
    double worst = 0;
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    for (std::size_t i = 0; i < a.size(); i++)
        for (std::size_t k = 0; k < 3; k++)
            worst = std::fmax(worst, std::fabs(a[i][k] - b[i][k]) / (1 + std::fabs(a[i][k])));
    return worst;
}

int main()
{
    const Set sets[] = {{"plain", 20000, 0},       {"few hidden", 20000, 1e-4}, {"some hidden", 20000, 1e-3},
                        {"most hidden", 20000, 1}, {"small", 200, 0.05},        {"five", 5, 0.01}};
    std::printf("%-12s %8s %8s | %10s %7s %7s | %10s %7s | %10s %7s\n", "points", "count", "hidden", "delotet", "s",
                "diagram", "CGAL", "s", "TetGen -v", "s");
    int failures = 0;
    for (const Set &set : sets) {
        std::vector<Point> points(set.count);
        std::vector<double> weights(set.count);
        for (std::size_t i = 0; i < set.count; i++) {
            points[i] = {uniform(), uniform(), uniform()};
            weights[i] = set.spread * uniform();
        }
        delotet::Options options;
        options.mode(delotet::Mode::delaunay);
        const Stopwatch watch;
        delotet::Plc plc(points);
        if (set.spread > 0)
            plc.set_point_weights(weights);
        const delotet::Mesh mesh = delotet::tetrahedralize(plc, options);
        const double seconds = watch.seconds();
        const Stopwatch second;
        const delotet::Voronoi diagram = mesh.voronoi();
        const double for_diagram = second.seconds();
        const std::vector<Tet> tets(mesh.tets().begin(), mesh.tets().end());
        const Result cgal = cgal_regular(points, weights);
        const Result tetgen = tetgen_diagram(points, set.spread > 0 ? weights : std::vector<double>(), 60);
        std::printf("%-12s %8zu %8zu | %10zu %7.3f %7.3f | %10zu %7.3f | ", set.name, set.count,
                    mesh.hidden_points().size(), tets.size(), seconds, for_diagram, cgal.tets.size(), cgal.seconds);
        if (tetgen.ok())
            std::printf("%10zu %7.3f\n", tetgen.tets.size(), tetgen.seconds);
        else
            std::printf("%10s\n", tetgen.outcome.c_str());
        const auto expect = [&](bool condition, const char *what) {
            if (!condition) {
                std::printf("  FAILED: %s\n", what);
                failures++;
            }
        };
        expect(sorted(tets) == sorted(cgal.tets), "the tetrahedra are CGAL's");
        if (tetgen.ok()) {
            expect(tetgen.tets.size() == tets.size(), "the count is TetGen's");
            const std::vector<Point> centers(diagram.vertices().begin(), diagram.vertices().end());
            const bool same = tetgen.centers.size() == centers.size();
            expect(same, "the number of vertices is TetGen's");
            if (same)
                std::printf("  centres differ from TetGen's by up to %.1e\n", farthest(centers, tetgen.centers));
        }
    }
    return failures != 0;
}
