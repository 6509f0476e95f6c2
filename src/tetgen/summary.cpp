// The counts at the end of a run, in lines as users' programs look for them.
#include "stages.hpp"

#include <algorithm>
#include <cmath>

namespace delotet_tetgen {

namespace {

/// Bounds of the bins of dihedral angles, in degrees.
constexpr double bins[] = {0, 5, 10, 20, 30, 40, 50, 60, 70, 80, 110, 120, 130, 140, 150, 160, 170, 175, 180};

/// The least and the greatest of some numbers.
struct Range {
    double least = no_wish, greatest = 0;

    void add(double x)
    {
        least = std::min(least, x);
        greatest = std::max(greatest, x);
    }
};

double length(const delotet::Point &a, const delotet::Point &b)
{
    double square = 0;
    for (std::size_t axis = 0; axis < 3; axis++)
        square += (b[axis] - a[axis]) * (b[axis] - a[axis]);
    return std::sqrt(square);
}

/// The angle across from the first of three sides of a triangle, in degrees.
double angle(double across, double b, double c)
{
    const double cosine = (b * b + c * c - across * across) / (2 * b * c);
    return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / 3.14159265358979323846;
}

void write_quality(const Call &call, const delotet::Mesh &mesh)
{
    const Log &log = call.log;
    Range volumes, edges, ratios, face_angles, dihedrals;
    unsigned long long counts[18] = {};
    const delotet::Span<const delotet::Point> points = mesh.points();
    for (std::size_t i = 0; i < mesh.tets().size(); i++) {
        const delotet::TetQuality &measures = mesh.quality()[i];
        const delotet::Tet &tet = mesh.tets()[i];
        volumes.add(measures.volume);
        for (const double dihedral : measures.dihedrals) {
            dihedrals.add(dihedral);
            const std::ptrdiff_t bin = std::upper_bound(bins, bins + 18, dihedral) - bins;
            counts[std::max<std::ptrdiff_t>(bin, 1) - 1]++;
        }
        double longest = 0, largest = 0; // edge, face
        for (std::size_t corner = 0; corner < 4; corner++) {
            const delotet::Point &a = points[tet[(corner + 1) % 4]], &b = points[tet[(corner + 2) % 4]], &c = points[tet[(corner + 3) % 4]];
            const double ab = length(a, b), bc = length(b, c), ca = length(c, a), half = (ab + bc + ca) / 2;
            largest = std::max(largest, std::sqrt(std::max(0.0, half * (half - ab) * (half - bc) * (half - ca))));
            for (const double side : {ab, bc, ca}) {
                edges.add(side);
                longest = std::max(longest, side);
            }
            face_angles.add(angle(ab, bc, ca));
            face_angles.add(angle(bc, ca, ab));
            face_angles.add(angle(ca, ab, bc));
        }
        if (measures.volume > 0)
            ratios.add(longest * largest / (3 * measures.volume)); // The longest edge over the smallest height.
    }
    log.line("Mesh quality statistics:\n");
    log.line("  Smallest volume: %16.5g   |  Largest volume: %16.5g", volumes.least, volumes.greatest);
    log.line("  Shortest edge:   %16.5g   |  Longest edge:   %16.5g", edges.least, edges.greatest);
    log.line("  Smallest asp.ratio: %13.5g   |  Largest asp.ratio: %13.5g", ratios.least, ratios.greatest);
    log.line("  Smallest facangle: %14.5g   |  Largest facangle:     %10.4f", face_angles.least, face_angles.greatest);
    log.line("  Smallest dihedral: %14.5g   |  Largest dihedral:     %10.4f\n", dihedrals.least, dihedrals.greatest);
    log.line("  Dihedral angle histogram:");
    for (std::size_t i = 0; i < 9; i++)
        log.line("     %3g - %2g degrees:  %8llu      |    %3g - %3g degrees:  %8llu", bins[i], bins[i + 1], counts[i], bins[i + 9],
                 bins[i + 10], counts[i + 9]);
    log.line("%s", "");
}

} // namespace

void write_summary(const Call &call, const Result *result, const tetgenio &out)
{
    const Log &log = call.log;
    if (!log)
        return;
    const tetgenio &in = call.in;
    const tetgenbehavior &switches = call.switches;
    const delotet::Mesh empty;
    const delotet::Mesh &mesh = result ? result->mesh : empty;
    std::size_t on_segments = 0, on_facets = 0, inside = 0, hull = 0;
    for (const delotet::SteinerPoint &point : mesh.steiner_points())
        (point.facet != delotet::invalid_index ? on_facets : point.ends[0] != delotet::invalid_index ? on_segments : inside)++;
    for (const delotet::Tet &row : mesh.neighbors())
        hull += static_cast<std::size_t>(std::count(row.begin(), row.end(), delotet::invalid_index));
    std::size_t exterior = 0;
    for (const delotet::Subface &face : mesh.subfaces())
        exterior += face.tets[1] == delotet::invalid_index;
    const bool old = call.rules == Rules::v150;
    const bool surface = switches.plc || switches.refine;

    log.line("\nStatistics:\n");
    log.line("  Input points: %d", in.numberofpoints);
    if (switches.refine) {
        log.line("  Input tetrahedra: %d", in.numberoftetrahedra);
    } else if (switches.plc) {
        const std::size_t pieces = mesh.subsegments().size() + mesh.unmeshed_subsegments().size();
        log.line("  Input facets: %d", in.numberoffacets);
        log.line("  Input segments: %zu", pieces - std::min(pieces, on_segments));
        log.line("  Input holes: %d", in.numberofholes);
        log.line("  Input regions: %d", in.numberofregions);
    }
    const std::size_t tets = mesh.tets().size(), faces = (4 * tets + hull) / 2;
    log.line("\n  Mesh points: %zu", result ? mesh.points().size() - mesh.unmeshed_points().size() : std::size_t{0});
    log.line("  Mesh tetrahedra: %zu", tets);
    log.line("  Mesh faces: %zu", faces);
    if (surface && old) {
        log.line("  Mesh faces on facets: %zu", mesh.subfaces().size());
        log.line("  Mesh edges on segments: %zu", mesh.subsegments().size());
    } else if (surface) {
        log.line("  Mesh faces on exterior boundary: %zu", exterior);
        log.line("  Mesh faces on input facets: %zu", mesh.subfaces().size());
        log.line("  Mesh edges on input segments: %zu", mesh.subsegments().size());
    } else if (result) {
        log.line("  Mesh edges: %zu", mesh.edges().size());
        log.line("  Convex hull faces: %zu", hull);
    }
    if (switches.order == 2 && result)
        log.line("  Mesh nodes of second order: %d", out.numberofpoints);
    if (inside > 0)
        log.line("  Steiner points inside domain: %zu", inside);
    if (on_facets > 0)
        log.line("  Steiner points on facets:  %zu", on_facets);
    if (on_segments > 0)
        log.line("  Steiner points on segments:  %zu", on_segments);
    log.line("%s", "");
    if (log.verbose() && tets > 0)
        write_quality(call, mesh);
}

} // namespace delotet_tetgen
