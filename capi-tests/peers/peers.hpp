// What the comparisons share: meshes as plain arrays, the peers, and exact tests by CGAL.
#ifndef DELOTET_PEERS_HPP
#define DELOTET_PEERS_HPP
#include <array>
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

using Point = std::array<double, 3>;
using Triangle = std::array<std::uint32_t, 3>;
using Tet = std::array<std::uint32_t, 4>;

/// A mesh of any program. Tetrahedra are positive.
struct Result {
    std::string outcome = "ok"; ///< "ok", or how the peer ended.
    double seconds = 0;
    std::vector<Point> points;
    std::vector<Tet> tets;
    std::vector<Triangle> constraints; ///< Faces that need not be locally Delaunay.
    std::vector<Point> centers;        ///< The vertices of the Voronoi diagram, where it was asked for.
    bool ok() const { return outcome == "ok"; }
};

/// A triangulated surface.
struct Model {
    std::vector<Point> points;
    std::vector<Triangle> triangles;
};

/// An OFF file of triangles; empty if it is something else.
Model read(const char *path);

/// The triangles are one closed oriented surface that bounds its inside once: their signed volume is the enclosed volume.
bool is_one_surface(const Model &model);

/// The same looking the other way.
std::vector<Triangle> reversed(std::vector<Triangle> triangles);

class Stopwatch {
  public:
    double seconds() const
    {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// TetGen in a child process: it may abort, crash or hang there. Without triangles the Delaunay tetrahedralization; `preserved`: no
/// points on the boundary (-pY).
Result tetgen(const std::vector<Point> &points, const std::vector<Triangle> &triangles, unsigned limit_seconds,
              bool preserved = false);

/// TetGen's weighted Delaunay tetrahedralization (-w) and power diagram (-v), in a child process; without weights, the plain ones.
Result tetgen_diagram(const std::vector<Point> &points, const std::vector<double> &weights, unsigned limit_seconds);

/// CGAL's Delaunay tetrahedralization.
Result cgal_delaunay(const std::vector<Point> &points);

/// CGAL's regular triangulation of weighted points.
Result cgal_regular(const std::vector<Point> &points, const std::vector<double> &weights);

/// Four points lie in one plane, exactly.
bool coplanar(const Point &a, const Point &b, const Point &c, const Point &d);

/// Tetrahedra with exactly zero or negative volume.
std::size_t not_positive(const Result &mesh);

/// Inner faces off the constraints with a vertex strictly inside the circumsphere on the other side, by exact predicates.
std::size_t not_delaunay(const Result &mesh);

/// Six times a volume: exact, as text; sums over tetrahedra, and over the cones of triangles above the origin.
std::string exact_volume(const std::vector<Point> &points, const std::vector<Tet> &tets);
std::string exact_volume(const std::vector<Point> &points, const std::vector<Triangle> &triangles);
/// The same in doubles, of the exact sum.
double rounded_volume(const std::vector<Point> &points, const std::vector<Tet> &tets);
double rounded_volume(const std::vector<Point> &points, const std::vector<Triangle> &triangles);
#endif
