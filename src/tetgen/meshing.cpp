// The mesh of a PLC, within a limit on points (S) and until the caller's function is content.
#include "stages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace delotet_tetgen {

namespace {

/// A segment with a bound on the length of its pieces.
struct BoundedSegment {
    delotet::Point from, along; // one end, and the way to the other
    double square;              // of its length
    double length;              // that is wanted
    std::size_t segment;        // of the domain
};

std::vector<BoundedSegment> bounded_segments(const Domain &domain)
{
    std::vector<BoundedSegment> bounded;
    const delotet::Span<const delotet::Point> points = domain.plc.points();
    for (std::size_t i = 0; i < domain.segments.size(); i++) {
        const InputSegment &segment = domain.segments[i];
        if (!(segment.length < no_wish))
            continue;
        BoundedSegment one = {points[segment.ends[0]], {}, 0, segment.length, i};
        for (std::size_t axis = 0; axis < 3; axis++) {
            one.along[axis] = points[segment.ends[1]][axis] - one.from[axis];
            one.square += one.along[axis] * one.along[axis];
        }
        if (one.square > 0)
            bounded.push_back(one);
    }
    return bounded;
}

/// The length wanted at a place: on a segment its bound, which grows with the distance. (The engine's own lengths of segments hold at
/// their ends.)
double length_at(const std::vector<BoundedSegment> &segments, const delotet::Point &at)
{
    double length = no_wish;
    for (const BoundedSegment &segment : segments) {
        double along = 0, square = 0;
        for (std::size_t axis = 0; axis < 3; axis++)
            along += (at[axis] - segment.from[axis]) * segment.along[axis];
        const double t = std::clamp(along / segment.square, 0.0, 1.0);
        for (std::size_t axis = 0; axis < 3; axis++) {
            const double d = at[axis] - segment.from[axis] - t * segment.along[axis];
            square += d * d;
        }
        length = std::min(length, segment.length + std::sqrt(square));
    }
    return length;
}

/// Shortens what is wanted on segments that have pieces above their bounds. Whether there are any.
bool shorten(const Domain &domain, const delotet::Mesh &mesh, std::vector<BoundedSegment> &bounds)
{
    std::vector<double> longest(bounds.empty() ? 0 : domain.segments.size());
    for (std::size_t i = 0; !bounds.empty() && i < mesh.subsegments().size(); i++) {
        const delotet::Subsegment &piece = mesh.subsegments()[i];
        if (piece.segment == delotet::invalid_index)
            continue;
        double square = 0;
        for (std::size_t axis = 0; axis < 3; axis++) {
            const double d = mesh.points()[piece.ends[1]][axis] - mesh.points()[piece.ends[0]][axis];
            square += d * d;
        }
        longest[piece.segment] = std::max(longest[piece.segment], std::sqrt(square));
    }
    bool any = false;
    for (BoundedSegment &bound : bounds) {
        const double allowed = domain.segments[bound.segment].length;
        if (longest[bound.segment] <= allowed)
            continue;
        bound.length *= std::clamp(0.95 * allowed / longest[bound.segment], 0.3, 0.9);
        any = true;
    }
    return any;
}

/// Makes the mesh of a PLC. A limit on the number of points (S) ends refinement: sizes and shapes are relaxed until it is kept.
delotet::Mesh attempt(const Call &call, const Domain &domain, bool bounded, const Background &background)
{
    const tetgenbehavior &switches = call.switches;
    std::vector<BoundedSegment> bounds = bounded_segments(domain);
    // Lengths bound pieces only on the average, so they are shortened until the bounds hold; few rounds do, where they can.
    int rounds = fills(call, bounded) ? 6 : 0;
    for (int relaxed = 0;; relaxed = relaxed == 8 ? -1 : relaxed + 1) {
        delotet::Options options = options_of(call, bounded, relaxed);
        if (switches.nobisect) {
            options.mode(delotet::Mode::preserve);
            options.preserve(switches.nobisect > 1 ? delotet::Preserve::all : delotet::Preserve::outer);
        } else if (!switches.nomergefacet && switches.facet_separate_ang_tol >= 90 && switches.facet_separate_ang_tol <= 180) {
            options.merge_facets(switches.facet_separate_ang_tol);
        }
        options.keep_hull(switches.convex != 0);
        if (relaxed >= 0 && background.mesh)
            options.background(*background.mesh, background.sizes);
        else if (relaxed >= 0)
            set_background(call, options);
        if (relaxed == 0 && !bounds.empty() && fills(call, bounded))
            options.size_function([&bounds](const delotet::Point &at) { return length_at(bounds, at); });
        try {
            delotet::Mesh mesh = delotet::tetrahedralize(domain.plc, options);
            if (relaxed == 0)
                while (rounds-- > 0 && shorten(domain, mesh, bounds))
                    mesh = delotet::tetrahedralize(domain.plc, options);
            return mesh;
        } catch (const delotet::Exception &failure) {
            if (failure.status() != DELOTET_STATUS_STEINER_LIMIT || switches.steinerleft < 0 || relaxed < 0 || !fills(call, bounded))
                throw;
            call.log.detail("  More than %d points are wanted: sizes are relaxed.", switches.steinerleft);
        }
    }
}

/// The sizes of a background at points: linear in its tetrahedra.
std::vector<double> interpolated(const Background &background, delotet::Span<const delotet::Point> points)
{
    std::vector<double> sizes(points.size(), no_wish);
    if (!background.mesh || background.sizes.empty())
        return sizes;
    std::vector<Index> tets(points.size());
    std::vector<std::array<double, 4>> weights(points.size());
    background.mesh->locate(points, tets, weights);
    for (std::size_t i = 0; i < points.size(); i++) {
        if (tets[i] == delotet::invalid_index)
            continue;
        double size = 0;
        for (std::size_t k = 0; k < 4; k++) // No 0 times infinity.
            size += weights[i][k] > 0 ? weights[i][k] * background.sizes[background.mesh->tets()[tets[i]][k]] : 0;
        if (size > 0)
            sizes[i] = size;
    }
    return sizes;
}

/// The lengths wanted at the points of a mesh in the eyes of the caller: shorter than before in tetrahedra that are to be split, elsewhere as
/// they are. Empty if all tetrahedra suit. `before`: the lengths of the last round.
std::vector<double> unsuitable(const Call &call, const delotet::Mesh &mesh, const Background &before)
{
    const delotet::Span<const delotet::Point> points = mesh.points();
    std::vector<double> local(points.size());
    std::vector<bool> splits(points.size());
    const delotet::Records<delotet::TetQuality> quality = mesh.quality();
    bool any = false;
    for (std::size_t i = 0; i < mesh.tets().size(); i++) {
        const delotet::Tet &tet = mesh.tets()[i];
        double corners[4][3], edges[6], longest = 0;
        for (std::size_t k = 0; k < 4; k++)
            std::copy(points[tet[k]].begin(), points[tet[k]].end(), corners[k]);
        for (std::size_t a = 0, edge = 0; a < 4; a++)
            for (std::size_t b = a + 1; b < 4; b++, edge++) {
                double square = 0;
                for (std::size_t axis = 0; axis < 3; axis++)
                    square += (corners[a][axis] - corners[b][axis]) * (corners[a][axis] - corners[b][axis]);
                edges[edge] = std::sqrt(square);
                longest = std::max(longest, edges[edge]);
            }
        const bool split = call.in.tetunsuitable(corners[0], corners[1], corners[2], corners[3], edges, quality[i].volume);
        any |= split;
        for (const Index corner : tet) {
            local[corner] = std::max(local[corner], longest);
            splits[corner] = splits[corner] || split;
        }
    }
    if (!any)
        return {};
    // What has been reached is kept: sizes bound edges only on the average, so they may not grow again.
    std::vector<double> lengths = interpolated(before, points);
    for (std::size_t i = 0; i < lengths.size(); i++)
        if (local[i] > 0)
            lengths[i] = std::min(lengths[i], local[i]) * (splits[i] ? 0.6 : 1);
    return lengths;
}

} // namespace

/// Meshes until the caller's function finds no tetrahedron unsuitable. Each round shortens the lengths there, so it ends for any function that
/// looks at sizes; what one that is never content gets has lengths of a thousandth at most.
delotet::Mesh mesh_of(const Call &call, const Domain &domain, bool bounded, const Background &background)
{
    const tetgenbehavior &switches = call.switches;
    delotet::Mesh mesh = attempt(call, domain, bounded, background);
    if (!call.in.tetunsuitable || !(switches.quality || switches.fixedvolume || switches.varvolume))
        return mesh;
    delotet::Mesh coarse;
    Background last = background;
    for (int round = 0; round < 14; round++) {
        std::vector<double> lengths = unsuitable(call, mesh, last);
        if (lengths.empty())
            return mesh;
        coarse = std::move(mesh);
        last = {&coarse, std::move(lengths)};
        mesh = attempt(call, domain, true, last);
    }
    return mesh;
}

} // namespace delotet_tetgen
