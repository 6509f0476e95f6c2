// A tetgenio as a PLC: points, facets of any number of polygons, segments, seeds, and bounds by markers.
//
// Only what TetGen itself would read is read: programs leave members of facets and polygons that they do not need as they are.
#include "stages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace delotet_tetgen {

namespace {

using delotet::Marker;

std::size_t size(int count)
{
    return count > 0 ? static_cast<std::size_t>(count) : 0;
}

/// The polygons of one facet without repeated corners, by what they are.
struct Polygons {
    std::vector<Index> corners;     // rings of three corners or more, edges, then points
    std::vector<std::size_t> ends;  // of each polygon
    std::size_t rings = 0, edges = 0;
    bool simple = true;             // no ring meets a corner twice
};

bool repeats(const std::vector<Index> &ring)
{
    std::vector<Index> sorted = ring;
    std::sort(sorted.begin(), sorted.end());
    return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
}

Polygons polygons_of(const Call &call, const tetgenio::facet &facet, std::size_t number)
{
    std::vector<std::vector<Index>> rings, edges, points;
    Polygons polygons;
    if (facet.numberofpolygons > 0 && !facet.polygonlist)
        call.log.fail(bad_input, "Facet %zu has no list of polygons.", number);
    for (std::size_t i = 0; i < size(facet.numberofpolygons); i++) {
        const tetgenio::polygon &polygon = facet.polygonlist[i];
        if (polygon.numberofvertices > 0 && !polygon.vertexlist)
            call.log.fail(bad_input, "A polygon of facet %zu has no list of vertices.", number);
        std::vector<Index> ring;
        for (std::size_t k = 0; k < size(polygon.numberofvertices); k++) {
            const Index corner = point_of(call, call.in, polygon.vertexlist[k], "facet", number);
            if (ring.empty() || ring.back() != corner)
                ring.push_back(corner);
        }
        while (ring.size() > 1 && ring.front() == ring.back())
            ring.pop_back();
        if (ring.size() > 3 && repeats(ring)) {
            // Walked along an edge twice to an inner outline, or pinched: its edges say the same.
            polygons.simple = false;
            for (std::size_t k = 0; k < ring.size(); k++)
                edges.push_back({ring[k], ring[(k + 1) % ring.size()]});
        } else if (!ring.empty()) {
            (ring.size() > 2 ? rings : ring.size() == 2 ? edges : points).push_back(std::move(ring));
        }
    }
    polygons.rings = rings.size();
    polygons.edges = edges.size();
    for (const std::vector<std::vector<Index>> *list : {&rings, &edges, &points})
        for (const std::vector<Index> &ring : *list) {
            polygons.corners.insert(polygons.corners.end(), ring.begin(), ring.end());
            polygons.ends.push_back(polygons.corners.size());
        }
    return polygons;
}

/// The corners of a facet of one triangle: what most facets are.
bool is_triangle(const Call &call, const tetgenio::facet &facet, std::size_t number, Index *corners)
{
    if (facet.numberofpolygons != 1 || !facet.polygonlist || facet.polygonlist->numberofvertices != 3 || !facet.polygonlist->vertexlist)
        return false;
    for (std::size_t k = 0; k < 3; k++)
        corners[k] = point_of(call, call.in, facet.polygonlist->vertexlist[k], "facet", number);
    return corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0];
}

/// Whether every end of the edges of a facet is that of two at least, so that they may bound an area.
bool closed(const Polygons &polygons)
{
    std::vector<Index> ends(polygons.corners.begin(),
                            polygons.corners.begin() + static_cast<std::ptrdiff_t>(polygons.ends[polygons.edges - 1]));
    std::sort(ends.begin(), ends.end());
    for (std::size_t i = 0; i < ends.size();) {
        const std::size_t next = static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), ends[i]) - ends.begin());
        if (next - i < 2)
            return false;
        i = next;
    }
    return polygons.edges > 2;
}

/// Joins edges that end in a common point to rings, as long as every point has two of them; else they stay edges.
void join(Polygons &polygons)
{
    struct End {
        Index at, edge;
    };
    std::vector<End> ends;
    for (std::size_t i = 0; i < polygons.edges; i++)
        for (std::size_t k = 0; k < 2; k++)
            ends.push_back({polygons.corners[2 * i + k], static_cast<Index>(i)});
    std::stable_sort(ends.begin(), ends.end(), [](const End &a, const End &b) { return a.at < b.at; });
    for (std::size_t i = 0; i < ends.size(); i += 2)
        if (i + 1 == ends.size() || ends[i].at != ends[i + 1].at || (i + 2 < ends.size() && ends[i].at == ends[i + 2].at))
            return;
    std::vector<bool> used(polygons.edges);
    std::vector<Index> corners;
    std::vector<std::size_t> ring_ends;
    for (std::size_t first = 0; first < polygons.edges; first++) {
        for (std::size_t edge = first, side = 0; !used[edge];) {
            used[edge] = true;
            corners.push_back(polygons.corners[2 * edge + side]);
            const Index at = polygons.corners[2 * edge + 1 - side];
            const auto found = std::lower_bound(ends.begin(), ends.end(), at, [](const End &a, Index b) { return a.at < b; });
            edge = found[0].edge == edge ? found[1].edge : found[0].edge;
            side = polygons.corners[2 * edge] == at ? 0 : 1;
        }
        if (!corners.empty() && (ring_ends.empty() || ring_ends.back() != corners.size()))
            ring_ends.push_back(corners.size());
    }
    const std::size_t shift = corners.size();
    corners.insert(corners.end(), polygons.corners.begin() + static_cast<std::ptrdiff_t>(2 * polygons.edges), polygons.corners.end());
    polygons.rings = ring_ends.size();
    for (std::size_t i = polygons.edges; i < polygons.ends.size(); i++)
        ring_ends.push_back(polygons.ends[i] - 2 * polygons.edges + shift);
    polygons.corners = std::move(corners);
    polygons.ends = std::move(ring_ends);
    polygons.edges = 0;
}

/// Adds facets to a PLC, runs of triangles and of single polygons in one call each.
class Facets {
  public:
    explicit Facets(Domain &domain) : domain_(domain) {}

    void add_triangle(const Index *corners, Marker marker, std::size_t origin)
    {
        begin(true);
        corners_.insert(corners_.end(), corners, corners + 3);
        markers_.push_back(marker);
        domain_.facets.push_back(origin);
    }
    void add_polygon(const std::vector<Index> &corners, Marker marker, std::size_t origin)
    {
        if (corners.size() == 3)
            return add_triangle(corners.data(), marker, origin);
        begin(false);
        corners_.insert(corners_.end(), corners.begin(), corners.end());
        ends_.push_back(corners_.size());
        markers_.push_back(marker);
        domain_.facets.push_back(origin);
    }
    void add(const Polygons &polygons, const std::vector<delotet::Point> &holes, Marker marker, std::size_t origin)
    {
        flush();
        domain_.plc.add_facet_with_hole_seeds(polygons.corners, polygons.ends, holes, marker);
        domain_.facets.push_back(origin);
    }
    void flush()
    {
        if (!markers_.empty() && triangles_)
            domain_.plc.add_triangles(corners_, markers_);
        else if (!markers_.empty())
            domain_.plc.add_polygons(corners_, ends_, markers_);
        corners_.clear();
        ends_.clear();
        markers_.clear();
    }

  private:
    void begin(bool triangles)
    {
        if (triangles_ != triangles)
            flush();
        triangles_ = triangles;
    }

    Domain &domain_;
    std::vector<Index> corners_;
    std::vector<std::size_t> ends_;
    std::vector<Marker> markers_;
    bool triangles_ = true;
};

void add_seeds(const Call &call, Domain &domain, const LeftOut &left_out)
{
    const tetgenio &in = call.in;
    if ((call.switches.regionattrib || call.switches.varvolume) && in.regionlist)
        for (std::size_t i = 0; i < size(in.numberofregions); i++) {
            const double *region = in.regionlist + 5 * i;
            if (LeftOut::has(left_out.regions, i))
                continue;
            Seed seed;
            seed.at = {region[0], region[1], region[2]};
            // Attributes count as integers; what no int holds would be undefined.
            if (!(std::abs(region[3]) < 2147483648.0))
                call.log.fail(bad_input, "The attribute of region %zu is not an integer.", i + 1);
            seed.attribute = static_cast<int>(region[3]);
            if (call.switches.varvolume && region[4] > 0)
                seed.max_volume = region[4];
            seed.origin = i;
            domain.bounded |= seed.max_volume > 0;
            domain.seeds.push_back(seed);
        }
    if (in.holelist)
        for (std::size_t i = 0; i < size(in.numberofholes); i++) {
            const double *hole = in.holelist + 3 * i;
            if (LeftOut::has(left_out.holes, i))
                continue;
            if (call.switches.convex) {
                Seed seed;
                seed.at = {hole[0], hole[1], hole[2]};
                seed.hole = true;
                seed.origin = i;
                domain.seeds.push_back(seed);
            } else {
                domain.plc.add_hole({hole[0], hole[1], hole[2]});
                domain.holes.push_back(i);
            }
        }
    for (const Seed &seed : domain.seeds)
        domain.plc.add_region(seed.at, seed.attribute, seed.max_volume);
}

/// The edges of facets and the segments with the bounds on their lengths: bounds of other pairs of points have no effect.
void bound_segments(const Call &call, const Domain &domain, std::vector<InputSegment> &segments)
{
    const tetgenio &in = call.in;
    if (!in.segmentconstraintlist || in.numberofsegmentconstraints <= 0)
        return;
    std::vector<std::array<Index, 2>> edges;
    const auto pair = [](Index a, Index b) { return std::array<Index, 2>{std::min(a, b), std::max(a, b)}; };
    for (const InputSegment &segment : segments)
        edges.push_back(pair(segment.ends[0], segment.ends[1]));
    for (std::size_t facet = 0; facet < domain.plc.facet_count(); facet++)
        for (std::size_t ring = 0; ring < domain.plc.facet_ring_count(static_cast<Index>(facet)); ring++) {
            const delotet::Span<const Index> corners = domain.plc.facet_ring(static_cast<Index>(facet), ring);
            for (std::size_t i = 0; i < corners.size(); i++)
                edges.push_back(pair(corners[i], corners[(i + 1) % corners.size()]));
        }
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0; i < size(in.numberofsegmentconstraints); i++) {
        const double *bound = in.segmentconstraintlist + 3 * i;
        if (!(bound[2] > 0))
            continue;
        InputSegment segment;
        for (std::size_t k = 0; k < 2; k++) {
            if (!(std::abs(bound[k]) < 2147483648.0))
                call.log.fail(bad_input, "Segment constraint %zu has no such end.", i + 1);
            segment.ends[k] = point_of(call, in, static_cast<int>(bound[k]), "segment constraint", i + 1);
        }
        if (!std::binary_search(edges.begin(), edges.end(), pair(segment.ends[0], segment.ends[1]))) {
            call.log.line("Warning:  Segment constraint %zu is on no segment and has no effect.", i + 1);
            continue;
        }
        segment.marker = call.automatic_marker();
        segment.length = bound[2];
        segment.origin = segments.size();
        segments.push_back(segment);
    }
}

} // namespace

Domain domain_of(const Call &call, const LeftOut &left_out)
{
    const tetgenio &in = call.in;
    Domain domain;
    domain.plc = delotet::Plc(points_of(in));
    std::vector<InputSegment> segments;
    const auto add_segment = [&](Index a, Index b, int marker, bool marked) {
        InputSegment segment;
        segment.ends[0] = a;
        segment.ends[1] = b;
        segment.marker = marker;
        segment.marked = marked;
        segment.origin = segments.size();
        // Points at one place count as one.
        if (a != b && !std::equal(in.pointlist + 3 * std::size_t{a}, in.pointlist + 3 * std::size_t{a} + 3, in.pointlist + 3 * std::size_t{b}))
            segments.push_back(segment);
    };
    if (in.numberoffacets > 0 && !in.facetlist)
        call.log.fail(bad_input, "There are %d facets but no list of them.", in.numberoffacets);
    Facets facets(domain);
    for (std::size_t i = 0; i < size(in.numberoffacets); i++) {
        const tetgenio::facet &facet = in.facetlist[i];
        if (LeftOut::has(left_out.facets, i))
            continue;
        const Marker marker = in.facetmarkerlist ? in.facetmarkerlist[i] : call.automatic_marker();
        Index corners[3];
        if (!call.switches.nomergefacet && is_triangle(call, facet, i + 1, corners)) {
            facets.add_triangle(corners, marker, i);
            continue;
        }
        Polygons polygons = polygons_of(call, facet, i + 1);
        if (polygons.rings == 0 && polygons.edges > 0 && closed(polygons))
            join(polygons);
        if (call.switches.nomergefacet) // Every edge of a facet stays an edge.
            for (std::size_t k = 0, from = 0; k < polygons.rings; from = polygons.ends[k], k++)
                for (std::size_t c = from; c < polygons.ends[k]; c++)
                    add_segment(polygons.corners[c], polygons.corners[c + 1 == polygons.ends[k] ? from : c + 1],
                                call.automatic_marker(), false);
        if (polygons.ends.size() == 1 && polygons.rings == 1) {
            facets.add_polygon(polygons.corners, marker, i);
        } else if (polygons.rings > 0 || (polygons.edges > 0 && closed(polygons))) {
            std::vector<delotet::Point> holes;
            for (std::size_t k = 0; facet.holelist && k < size(facet.numberofholes); k++)
                holes.push_back({facet.holelist[3 * k], facet.holelist[3 * k + 1], facet.holelist[3 * k + 2]});
            facets.add(polygons, holes, marker, i);
        } else { // Segments and points: points of the input are in the mesh in any case.
            for (std::size_t k = 0; k < polygons.edges; k++)
                add_segment(polygons.corners[2 * k], polygons.corners[2 * k + 1], call.automatic_marker(), false);
        }
    }
    facets.flush();
    if (in.edgelist)
        for (std::size_t i = 0; i < size(in.numberofedges); i++)
            add_segment(point_of(call, in, in.edgelist[2 * i], "edge", i + 1), point_of(call, in, in.edgelist[2 * i + 1], "edge", i + 1),
                        in.edgemarkerlist ? in.edgemarkerlist[i] : call.automatic_marker(), in.edgemarkerlist != nullptr);
    add_seeds(call, domain, left_out);
    complete(call, domain, std::move(segments));
    return domain;
}

void complete(const Call &call, Domain &domain, std::vector<InputSegment> &&segments)
{
    const tetgenio &in = call.in;
    if (call.added_points() > 0) {
        const std::vector<delotet::Point> added = points_of(*call.addin);
        domain.plc.add_points(delotet::Span<const delotet::Point>(added));
    }
    bound_segments(call, domain, segments);
    // Of equal segments the first one with a marker counts, and the smallest length.
    for (InputSegment &segment : segments)
        if (segment.ends[0] > segment.ends[1])
            std::swap(segment.ends[0], segment.ends[1]);
    std::sort(segments.begin(), segments.end(), [](const InputSegment &a, const InputSegment &b) {
        return std::make_tuple(a.ends[0], a.ends[1], !a.marked, a.origin) < std::make_tuple(b.ends[0], b.ends[1], !b.marked, b.origin);
    });
    for (const InputSegment &segment : segments) {
        if (!domain.segments.empty() && std::equal(segment.ends, segment.ends + 2, domain.segments.back().ends)) {
            domain.segments.back().length = std::min(domain.segments.back().length, segment.length);
            continue;
        }
        domain.segments.push_back(segment);
    }
    std::vector<Index> ends;
    for (const InputSegment &segment : domain.segments)
        ends.insert(ends.end(), segment.ends, segment.ends + 2);
    domain.plc.add_segments(ends);
    if (in.facetconstraintlist)
        for (std::size_t i = 0; i < size(in.numberoffacetconstraints); i++) {
            const double *bound = in.facetconstraintlist + 2 * i;
            if (bound[1] > 0 && std::abs(bound[0]) < 2147483648.0)
                domain.plc.set_facet_area(static_cast<Marker>(bound[0]), bound[1]);
        }

    const PointRows rows = point_rows(call);
    if (rows.width() > 0)
        domain.plc.set_point_attributes(rows.data);
    std::vector<double> sizes = sizes_of(call, in);
    if (call.added_points() > 0) {
        const std::vector<double> more = sizes_of(call, *call.addin);
        if (!sizes.empty() || !more.empty()) {
            sizes.resize(call.input_points(), no_wish);
            sizes.insert(sizes.end(), more.begin(), more.end());
            sizes.resize(call.input_points() + call.added_points(), no_wish);
        }
    }
    if (!sizes.empty())
        domain.plc.set_point_sizes(sizes);
}

} // namespace delotet_tetgen
