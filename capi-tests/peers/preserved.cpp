// Preserved surfaces compared with TetGen's -pY: peers_preserved <off files>. Ours is judged: every triangle of the input is a face, no
// point is added on the surface, every tetrahedron is positive and the volume is the enclosed one, exactly. Prints a table with points
// inside, seconds, the smallest dihedral angle and the largest ratio of circumradius to shortest edge, ours and theirs; what the same tests
// say of TetGen's meshes is counted, not judged.
#include "ours.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <map>

using Vector = std::array<double, 3>;

static Vector operator-(const Point &a, const Point &b)
{
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
static double dot(const Vector &a, const Vector &b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
static Vector cross(const Vector &a, const Vector &b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

struct Quality {
    double dihedral = 180;  ///< Smallest, in degrees.
    double radius_edge = 0; ///< Largest.
};

/// The worst of all tetrahedra, in doubles.
static Quality quality(const Result &mesh)
{
    const double degrees = 180 / std::acos(-1.0);
    Quality worst;
    for (const Tet &tet : mesh.tets) {
        std::array<Point, 4> p;
        for (std::size_t i = 0; i < 4; i++)
            p[i] = mesh.points[tet[i]];
        // Outward normals; the angle between two faces is that of their normals from 180 degrees.
        const std::array<Vector, 4> normal = {cross(p[2] - p[1], p[3] - p[1]), cross(p[3] - p[0], p[2] - p[0]),
                                              cross(p[1] - p[0], p[3] - p[0]), cross(p[2] - p[0], p[1] - p[0])};
        double shortest = INFINITY;
        for (std::size_t i = 0; i < 4; i++)
            for (std::size_t j = i + 1; j < 4; j++) {
                const Vector n = cross(normal[i], normal[j]);
                const double angle = std::atan2(std::sqrt(dot(n, n)), -dot(normal[i], normal[j])) * degrees;
                worst.dihedral = std::min(worst.dihedral, angle);
                shortest = std::min(shortest, dot(p[i] - p[j], p[i] - p[j]));
            }
        const Vector a = p[1] - p[0], b = p[2] - p[0], c = p[3] - p[0];
        const Vector bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
        Vector centre;
        for (std::size_t k = 0; k < 3; k++)
            centre[k] = (dot(a, a) * bc[k] + dot(b, b) * ca[k] + dot(c, c) * ab[k]) / (2 * dot(a, bc));
        const double ratio = std::sqrt(dot(centre, centre) / shortest);
        worst.radius_edge = std::max(worst.radius_edge, std::isnan(ratio) ? INFINITY : ratio);
    }
    return worst;
}

/// For each point the first one equal to it.
static std::vector<std::uint32_t> aliases(const std::vector<Point> &points)
{
    std::map<Point, std::uint32_t> first;
    std::vector<std::uint32_t> alias;
    for (std::uint32_t i = 0; i < points.size(); i++)
        alias.push_back(first.emplace(points[i], i).first->second);
    return alias;
}

static Triangle sorted(Triangle face)
{
    std::sort(face.begin(), face.end());
    return face;
}

/// A mesh with the model's points first, by exact coordinates: TetGen drops points that it takes for equal.
static Result renumbered(const Result &mesh, const Model &model)
{
    Result out = mesh;
    out.points = model.points;
    std::map<Point, std::uint32_t> index;
    for (std::uint32_t i = 0; i < model.points.size(); i++)
        index.emplace(model.points[i], i);
    std::vector<std::uint32_t> number;
    for (const Point &point : mesh.points) {
        const auto [entry, is_new] = index.emplace(point, static_cast<std::uint32_t>(out.points.size()));
        if (is_new)
            out.points.push_back(point);
        number.push_back(entry->second);
    }
    for (Tet &tet : out.tets)
        for (std::uint32_t &corner : tet)
            corner = number[corner];
    return out;
}

/// Triangles of the model that are not faces of one or two tetrahedra.
static std::size_t not_faces(const Model &model, const Result &mesh)
{
    std::vector<Triangle> faces;
    faces.reserve(4 * mesh.tets.size());
    for (const Tet &tet : mesh.tets)
        for (std::size_t side = 0; side < 4; side++)
            faces.push_back(sorted({tet[(side + 1) % 4], tet[(side + 2) % 4], tet[(side + 3) % 4]}));
    std::sort(faces.begin(), faces.end());
    const std::vector<std::uint32_t> alias = aliases(model.points);
    std::size_t missing = 0;
    for (const Triangle &t : model.triangles) {
        const auto [from, to] =
            std::equal_range(faces.begin(), faces.end(), sorted({alias[t[0]], alias[t[1]], alias[t[2]]}));
        missing += from == to || to - from > 2;
    }
    return missing;
}

/// Boundary faces with a vertex that the input does not have.
static std::size_t added_on_surface(const Result &mesh, std::size_t inputs)
{
    std::map<Triangle, unsigned> uses;
    for (const Tet &tet : mesh.tets)
        for (std::size_t side = 0; side < 4; side++) {
            const Triangle face = sorted({tet[(side + 1) % 4], tet[(side + 2) % 4], tet[(side + 3) % 4]});
            if (face[2] >= inputs) // Sorted: added points are the last ones.
                uses[face]++;
        }
    return static_cast<std::size_t>(std::count_if(uses.begin(), uses.end(), [](const auto &use) { return use.second == 1; }));
}

/// One row: the figures of a mesh.
static void print(const Result &mesh, std::size_t inputs)
{
    const Quality worst = quality(mesh);
    std::printf("%8zu %6ld %8.3f %9.2e %9.2e", mesh.tets.size(),
                static_cast<long>(mesh.points.size()) - static_cast<long>(inputs), mesh.seconds, worst.dihedral,
                worst.radius_edge);
}

int main(int argc, char **argv)
{
    std::printf("%-30s %8s | %8s %6s %8s %9s %9s | %8s %6s %8s %9s %9s\n", "", "", "delotet", "", "", "least", "largest", "TetGen",
                "", "", "least", "largest");
    std::printf("%-30s %8s | %8s %6s %8s %9s %9s | %8s %6s %8s %9s %9s\n", "model", "facets", "tets", "inside", "s", "dihedral",
                "R/edge", "tets", "inside", "s", "dihedral", "R/edge");
    int failures = 0, models = 0, skipped = 0, lost = 0, theirs_bad = 0, better[2] = {0, 0};
    double seconds[2] = {0, 0};
    long inside[2] = {0, 0};
    delotet::Options options;
    options.mode(delotet::Mode::preserve);
    for (int i = 1; i < argc; i++) {
        const char *slash = std::strrchr(argv[i], '/');
        const Model model = read(argv[i]);
        if (model.triangles.empty()) {
            skipped++;
            continue;
        }
        models++;
        Ours run(model, options);
        delotet::Mesh &mesh = run.mesh;
        const delotet::Status status = run.status;
        Result &ours = run.result;
        const Result theirs = renumbered(tetgen(model.points, model.triangles, 60, true), model);
        const std::size_t inputs = model.points.size();
        std::printf("%-30.30s %8zu | ", slash ? slash + 1 : argv[i], model.triangles.size());
        std::string complaints;
        const auto expect = [&](bool condition, const std::string &what) {
            if (!condition) {
                complaints += "  FAILED: " + what + "\n";
                failures++;
            }
        };
        if (status == DELOTET_STATUS_OK) {
            print(ours, inputs);
            const std::size_t missing = not_faces(model, ours);
            expect(std::equal(model.points.begin(), model.points.end(), ours.points.begin()), "the points come first");
            expect(missing == 0, std::to_string(missing) + " triangles are no faces");
            expect(added_on_surface(ours, inputs) == 0, "no added point is on the boundary");
            expect(not_positive(ours) == 0, "every tetrahedron is positive");
            const bool passes = mesh.check_preserved(run.plc, 10, run.error) == DELOTET_STATUS_OK;
            expect(passes, run.error.message());
            expect(mesh.stats().preserve_interior == ours.points.size() - inputs, "the points inside are counted");
            if (is_one_surface(model)) {
                const std::string volume = exact_volume(ours.points, ours.tets);
                expect(volume == exact_volume(model.points, model.triangles) ||
                           volume == exact_volume(model.points, reversed(model.triangles)),
                       "the volume is the enclosed one, exactly");
            }
        } else {
            std::printf("%44s", delotet_status_name(status));
            expect(false, run.error.message());
        }
        std::printf(" | ");
        if (theirs.ok()) {
            print(theirs, inputs);
            theirs_bad += not_positive(theirs) != 0 || not_faces(model, theirs) != 0;
        } else {
            lost++;
            std::printf("%s", theirs.outcome.c_str());
        }
        if (theirs.ok() && status == DELOTET_STATUS_OK) {
            seconds[0] += ours.seconds;
            seconds[1] += theirs.seconds;
            inside[0] += static_cast<long>(ours.points.size() - inputs);
            inside[1] += static_cast<long>(theirs.points.size()) - static_cast<long>(inputs);
            const Quality a = quality(ours), b = quality(theirs);
            better[a.dihedral < b.dihedral]++;
        }
        std::printf("\n%s", complaints.c_str());
        std::fflush(stdout);
    }
    std::printf("\n%d models (%d more are not OFF triangles). On the %d that TetGen -pY meshes: delotet %.2f s, %ld points inside; "
                "TetGen %.2f s, %ld; the smallest dihedral angle is at least TetGen's on %d, smaller on %d.\nTetGen: %d abort, crash, "
                "time out or fail; %d meshes have tetrahedra that are not positive or lack triangles. delotet: %d failures.\n",
                models, skipped, models - lost, seconds[0], inside[0], seconds[1], inside[1], better[0], better[1], lost, theirs_bad,
                failures);
    return failures != 0 || models == 0;
}
