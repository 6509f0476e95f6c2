// Constrained Delaunay tetrahedralizations compared with TetGen's: peers_constrained <off files>. For each model the volume against the
// enclosed volume (exact rationals) and TetGen's, every facet covered, every unconstrained face locally Delaunay by CGAL's exact
// predicates. Prints a table; what the same tests say of TetGen's meshes is counted, not judged.
#include "ours.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <map>
#include <set>

/// For each facet the first one of its group: neighbours across an edge that lie in one plane, exactly, are meshed as one facet.
static std::vector<std::size_t> groups(const Model &model)
{
    std::vector<std::size_t> group(model.triangles.size());
    for (std::size_t f = 0; f < group.size(); f++)
        group[f] = f;
    const auto root = [&](std::size_t f) {
        while (group[f] != f)
            f = group[f] = group[group[f]];
        return f;
    };
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::size_t>> edges;
    for (std::size_t f = 0; f < group.size(); f++)
        for (std::size_t k = 0; k < 3; k++) {
            const std::uint32_t a = model.triangles[f][k], b = model.triangles[f][(k + 1) % 3];
            edges[{std::min(a, b), std::max(a, b)}].push_back(f);
        }
    for (const auto &[edge, around] : edges)
        for (std::size_t i = 1; i < around.size(); i++) {
            const Triangle &t = model.triangles[around[0]], &u = model.triangles[around[i]];
            bool flat = true;
            for (const std::uint32_t corner : u)
                flat = flat && coplanar(model.points[t[0]], model.points[t[1]], model.points[t[2]], model.points[corner]);
            if (flat)
                group[root(around[i])] = root(around[0]);
        }
    for (std::size_t f = 0; f < group.size(); f++)
        group[f] = root(f);
    return group;
}

/// Groups of facets that are not covered: the subfaces of a group must have, as a chain modulo 2, the group's boundary, whose edges
/// are subdivided by the Steiner points that lie on them; and every subface must be a face of the mesh.
static std::size_t not_covered(const Model &model, const delotet::Mesh &mesh)
{
    using Edge = std::pair<delotet::Index, delotet::Index>;
    const auto alias = mesh.point_aliases();
    // Points on an input edge (smaller end first), by parameter.
    std::map<Edge, std::set<std::pair<double, delotet::Index>>> on_edge;
    for (std::size_t i = 0; i < mesh.steiner_points().size(); i++) {
        const delotet::SteinerPoint &s = mesh.steiner_points()[i];
        const bool forward = s.ends[0] < s.ends[1];
        const Edge edge = forward ? Edge(s.ends[0], s.ends[1]) : Edge(s.ends[1], s.ends[0]);
        on_edge[edge].emplace(forward ? s.t : 1 - s.t, static_cast<delotet::Index>(mesh.input_point_count() + i));
    }
    std::set<Triangle> faces;
    for (const delotet::Tet &tet : mesh.tets())
        for (std::size_t side = 0; side < 4; side++) {
            Triangle face = {tet[(side + 1) % 4], tet[(side + 2) % 4], tet[(side + 3) % 4]};
            std::sort(face.begin(), face.end());
            faces.insert(face);
        }
    const std::vector<std::size_t> group = groups(model);
    std::vector<std::map<Edge, unsigned>> chains(model.triangles.size());
    std::vector<bool> has_subface(model.triangles.size());
    std::size_t bad = 0;
    for (const delotet::Subface &subface : mesh.subfaces()) {
        Triangle face = {subface.corners[0], subface.corners[1], subface.corners[2]};
        std::sort(face.begin(), face.end());
        bad += faces.count(face) == 0;
        has_subface[group[subface.facet]] = true;
        for (const Edge &edge : {Edge(face[0], face[1]), Edge(face[1], face[2]), Edge(face[0], face[2])})
            chains[group[subface.facet]][edge]++;
    }
    for (std::size_t f = 0; f < model.triangles.size(); f++)
        for (std::size_t k = 0; k < 3; k++) {
            const delotet::Index p = alias[model.triangles[f][k]], q = alias[model.triangles[f][(k + 1) % 3]];
            const auto found = on_edge.find({std::min(p, q), std::max(p, q)});
            std::vector<delotet::Index> path(1, std::min(p, q));
            if (found != on_edge.end())
                for (const auto &[t, point] : found->second)
                    path.push_back(point);
            path.push_back(std::max(p, q));
            for (std::size_t i = 0; i + 1 < path.size(); i++)
                chains[group[f]][{std::min(path[i], path[i + 1]), std::max(path[i], path[i + 1])}]++;
        }
    for (std::size_t f = 0; f < model.triangles.size(); f++)
        bad += group[f] == f && (!has_subface[f] || std::any_of(chains[f].begin(), chains[f].end(), [](const auto &entry) {
                                     return entry.second % 2 != 0;
                                 }));
    return bad;
}

static long added(const Result &mesh, const Model &model)
{
    return static_cast<long>(mesh.points.size()) - static_cast<long>(model.points.size());
}

int main(int argc, char **argv)
{
    std::printf("%-34s %8s | %9s %8s %8s %5s | %9s %8s %8s %5s\n", "", "", "delotet", "", "", "not", "TetGen", "", "", "not");
    std::printf("%-34s %8s | %9s %8s %8s %5s | %9s %8s %8s %5s\n", "model", "facets", "tets", "Steiner", "s", "Del.", "tets",
                "Steiner", "s", "Del.");
    int failures = 0, models = 0, exact = 0, skipped = 0, lost = 0, theirs_not_delaunay = 0;
    double seconds[2] = {0, 0};
    long steiner[2] = {0, 0}; // Net: TetGen drops points that it takes for equal.
    for (int i = 1; i < argc; i++) {
        const char *slash = std::strrchr(argv[i], '/');
        const char *name = slash ? slash + 1 : argv[i];
        const Model model = read(argv[i]);
        if (model.triangles.empty()) {
            skipped++;
            continue;
        }
        models++;
        Ours run(model, {});
        delotet::Mesh &mesh = run.mesh;
        const delotet::Status status = run.status;
        Result &ours = run.result;
        const Result theirs = tetgen(model.points, model.triangles, 60);
        std::printf("%-34.34s %8zu | ", name, model.triangles.size());
        std::string complaints;
        const auto expect = [&](bool condition, const std::string &what) {
            if (!condition) {
                complaints += "  FAILED: " + what + "\n";
                failures++;
            }
        };
        if (status == DELOTET_STATUS_OK) {
            bool rounded = false;
            for (const delotet::SteinerPoint &s : mesh.steiner_points())
                rounded = rounded || !s.exact;
            for (const delotet::Subface &subface : mesh.subfaces())
                ours.constraints.push_back({subface.corners[0], subface.corners[1], subface.corners[2]});
            const std::size_t wrong = not_delaunay(ours);
            std::printf("%9zu %8zu %8.3f %5zu | ", ours.tets.size(), mesh.steiner_points().size(), ours.seconds, wrong);
            expect(not_positive(ours) == 0, "every tetrahedron is positive");
            // Where Steiner points had to be rounded, faces may be locally Delaunay before rounding only.
            expect(wrong == 0 || rounded, "every unconstrained face is locally Delaunay");
            const std::size_t bare = not_covered(model, mesh);
            expect(bare == 0, std::to_string(bare) + " facets or subfaces are not covered");
            if (is_one_surface(model)) {
                if (!rounded) {
                    exact++;
                    expect(exact_volume(ours.points, ours.tets) == exact_volume(model.points, model.triangles),
                           "the volume is the enclosed one, exactly");
                }
                const double ratio =
                    rounded_volume(ours.points, ours.tets) / rounded_volume(model.points, model.triangles);
                expect(std::fabs(std::fabs(ratio) - 1) < 1e-12, "the volume is the enclosed one, to rounding");
            }
            if (theirs.ok()) { // Its own tolerances move its surface by more than rounding.
                const double ratio =
                    rounded_volume(ours.points, ours.tets) / std::fabs(rounded_volume(theirs.points, theirs.tets));
                if (std::fabs(ratio - 1) > 1e-6)
                    complaints += "  TetGen's volume is another: ours / theirs = " + std::to_string(ratio) + "\n";
                seconds[0] += ours.seconds;
                seconds[1] += theirs.seconds;
                steiner[0] += static_cast<long>(mesh.steiner_points().size());
                steiner[1] += added(theirs, model);
            }
        } else {
            std::printf("%33s | ", delotet_status_name(status));
            expect(false, run.error.message());
        }
        if (theirs.ok()) {
            const std::size_t wrong = not_delaunay(theirs);
            theirs_not_delaunay += wrong > 0;
            std::printf("%9zu %8ld %8.3f %5zu\n", theirs.tets.size(), added(theirs, model), theirs.seconds, wrong);
        } else {
            lost++;
            std::printf("%9s\n", theirs.outcome.c_str());
        }
        std::printf("%s", complaints.c_str());
        std::fflush(stdout);
    }
    std::printf("\n%d models (%d more are not OFF triangles), %d enclosed volumes compared exactly. On the %d that TetGen meshes: "
                "delotet %.2f s, %ld Steiner points; TetGen %.2f s, %ld.\nTetGen: %d abort, crash, time out or fail; %d meshes "
                "are not constrained Delaunay. delotet: %d failures.\n",
                models, skipped, exact, models - lost, seconds[0], steiner[0], seconds[1], steiner[1], lost,
                theirs_not_delaunay, failures);
    return failures != 0 || models == 0;
}
