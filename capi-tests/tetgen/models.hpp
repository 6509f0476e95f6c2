// Small models for the tests of the TetGen interface, made through its structures alone: any tetgen.h will do.
#ifndef DELOTET_TETGEN_MODELS_HPP
#define DELOTET_TETGEN_MODELS_HPP

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#ifndef REAL
#define REAL double
#endif

namespace models {

inline double *copy(const std::vector<double> &from)
{
    double *to = new double[from.size() + 1];
    for (std::size_t i = 0; i < from.size(); i++)
        to[i] = from[i];
    return to;
}

inline int *copy(const std::vector<int> &from)
{
    int *to = new int[from.size() + 1];
    for (std::size_t i = 0; i < from.size(); i++)
        to[i] = from[i];
    return to;
}

/// What a model is made of before it becomes a tetgenio; corners are counted from 0.
struct Parts {
    std::vector<double> xyz;
    std::vector<std::vector<std::vector<int>>> facets; // polygons of each facet
    std::vector<std::vector<double>> facet_holes;      // of each facet, or shorter
    std::vector<int> facet_markers, point_markers, edges, edge_markers;
    std::vector<double> holes, regions, sizes, attributes, facet_bounds, segment_bounds;

    int points() const { return static_cast<int>(xyz.size() / 3); }

    /// Six quadrilaterals, markers from `marker` on, or all `marker`.
    void box(double low, double high, int marker, bool one_marker = false)
    {
        const int at = points();
        for (int i = 0; i < 8; i++)
            xyz.insert(xyz.end(), {i & 1 ? high : low, i & 2 ? high : low, i & 4 ? high : low});
        const int sides[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
        for (int side = 0; side < 6; side++) {
            const int *q = sides[side];
            facets.push_back({{at + q[0], at + q[1], at + q[2], at + q[3]}});
            facet_markers.push_back(one_marker ? marker : marker + side);
        }
    }
    /// The same box of twelve triangles.
    void triangles()
    {
        std::vector<std::vector<std::vector<int>>> all;
        std::vector<int> markers;
        for (std::size_t i = 0; i < facets.size(); i++)
            for (const std::vector<int> &ring : facets[i])
                for (std::size_t k = 2; k < ring.size(); k++) {
                    all.push_back({{ring[0], ring[k - 1], ring[k]}});
                    if (!facet_markers.empty())
                        markers.push_back(facet_markers[i]);
                }
        facets = all;
        facet_markers = markers;
    }
};

template <class Io> void fill(Io &io, const Parts &parts, int first)
{
    io.firstnumber = first;
    io.numberofpoints = parts.points();
    io.pointlist = copy(parts.xyz);
    if (!parts.point_markers.empty())
        io.pointmarkerlist = copy(parts.point_markers);
    if (!parts.attributes.empty()) {
        io.numberofpointattributes = static_cast<int>(parts.attributes.size()) / parts.points();
        io.pointattributelist = copy(parts.attributes);
    }
    if (!parts.sizes.empty()) {
        io.numberofpointmtrs = 1;
        io.pointmtrlist = copy(parts.sizes);
    }
    if (!parts.facets.empty()) {
        io.numberoffacets = static_cast<int>(parts.facets.size());
        io.facetlist = new typename Io::facet[parts.facets.size()];
        if (!parts.facet_markers.empty())
            io.facetmarkerlist = copy(parts.facet_markers);
    }
    for (std::size_t i = 0; i < parts.facets.size(); i++) {
        typename Io::facet &facet = io.facetlist[i];
        facet.holelist = nullptr;
        facet.numberofholes = 0;
        if (i < parts.facet_holes.size() && !parts.facet_holes[i].empty()) {
            facet.holelist = copy(parts.facet_holes[i]);
            facet.numberofholes = static_cast<int>(parts.facet_holes[i].size() / 3);
        }
        facet.numberofpolygons = static_cast<int>(parts.facets[i].size());
        facet.polygonlist = new typename Io::polygon[parts.facets[i].size()];
        for (std::size_t k = 0; k < parts.facets[i].size(); k++) {
            std::vector<int> ring = parts.facets[i][k];
            for (int &corner : ring)
                corner += first;
            facet.polygonlist[k].vertexlist = copy(ring);
            facet.polygonlist[k].numberofvertices = static_cast<int>(ring.size());
        }
    }
    if (!parts.edges.empty()) {
        std::vector<int> ends = parts.edges;
        for (int &end : ends)
            end += first;
        io.numberofedges = static_cast<int>(parts.edges.size() / 2);
        io.edgelist = copy(ends);
        if (!parts.edge_markers.empty())
            io.edgemarkerlist = copy(parts.edge_markers);
    }
    if (!parts.holes.empty()) {
        io.numberofholes = static_cast<int>(parts.holes.size() / 3);
        io.holelist = copy(parts.holes);
    }
    if (!parts.regions.empty()) {
        io.numberofregions = static_cast<int>(parts.regions.size() / 5);
        io.regionlist = copy(parts.regions);
    }
    if (!parts.facet_bounds.empty()) {
        io.numberoffacetconstraints = static_cast<int>(parts.facet_bounds.size() / 2);
        io.facetconstraintlist = copy(parts.facet_bounds);
    }
    if (!parts.segment_bounds.empty()) {
        std::vector<double> bounds = parts.segment_bounds;
        for (std::size_t i = 0; i < bounds.size(); i++)
            if (i % 3 < 2)
                bounds[i] += first;
        io.numberofsegmentconstraints = static_cast<int>(bounds.size() / 3);
        io.segmentconstraintlist = copy(bounds);
    }
}

/// The polygons of an .off file.
inline Parts read_off(const char *path)
{
    Parts parts;
    std::FILE *file = std::fopen(path, "r");
    int points = 0, faces = 0, edges = 0, count = 0;
    if (!file || std::fscanf(file, "OFF %d %d %d", &points, &faces, &edges) != 3)
        points = faces = 0;
    for (int i = 0; i < 3 * points; i++) {
        double x = 0;
        if (std::fscanf(file, "%lf", &x) != 1)
            break;
        parts.xyz.push_back(x);
    }
    for (int i = 0; i < faces && std::fscanf(file, "%d", &count) == 1; i++) {
        std::vector<int> ring(static_cast<std::size_t>(count));
        for (int &corner : ring)
            if (std::fscanf(file, "%d", &corner) != 1)
                break;
        parts.facets.push_back({ring});
        for (int c = std::fgetc(file); c != '\n' && c != EOF;)
            c = std::fgetc(file);
    }
    if (file)
        std::fclose(file);
    return parts;
}

/// The model of a name, or of an .off file; empty if there is none.
inline Parts named(const std::string &name)
{
    Parts parts;
    if (name.size() > 4 && name.substr(name.size() - 4) == ".off")
        return read_off(name.c_str());
    if (name == "box") {
        parts.box(0, 2, 11);
    } else if (name == "unmarked") {
        parts.box(0, 2, 11);
        parts.facet_markers.clear();
    } else if (name == "triangles") { // A closed surface of triangles, no markers: what most callers give.
        parts.box(0, 2, 11);
        parts.triangles();
        parts.facet_markers.clear();
    } else if (name == "marked") { // Markers of points, an attribute, a marked edge.
        parts.box(0, 2, 11);
        parts.point_markers = {5, 6, 0, 0, -3, 0, 0, 9};
        for (int i = 0; i < 8; i++)
            parts.attributes.push_back(i);
        parts.edges = {0, 1};
        parts.edge_markers = {77};
    } else if (name == "nested" || name == "regions" || name == "seeded" || name == "hollow") {
        parts.box(-2, 2, 1);
        parts.box(-1, 1, 7, true);
        if (name == "regions")
            parts.regions = {0, 0, 0, 11, 0.1, 1.5, 1.5, 1.5, 22, 0.7};
        if (name == "seeded") // One of the two regions.
            parts.regions = {1.5, 1.5, 1.5, 22, 0.7};
        if (name == "hollow")
            parts.holes = {0.1, 0.2, 0.3};
    } else if (name == "bare") { // Nested boxes without markers.
        parts.box(-2, 2, 1);
        parts.box(-1, 1, 7);
        parts.facet_markers.clear();
    } else if (name == "zero") { // Nested boxes, some of their facets with the marker 0.
        parts.box(-2, 2, 0);
        parts.box(-1, 1, 0);
    } else if (name == "window") { // A wall with a hole in it, in a box.
        parts.box(0, 4, 1);
        const int at = parts.points();
        parts.xyz.insert(parts.xyz.end(), {1, 1, 2, 3, 1, 2, 3, 3, 2, 1, 3, 2, 1.5, 1.5, 2, 2.5, 1.5, 2, 2.5, 2.5, 2, 1.5, 2.5, 2});
        parts.facets.push_back({{at, at + 1, at + 2, at + 3}, {at + 4, at + 5, at + 6, at + 7}});
        parts.facet_markers.push_back(9);
        parts.facet_holes.resize(parts.facets.size());
        parts.facet_holes.back() = {2, 2, 2};
    } else if (name == "pieces") { // A segment and a point as facets of their own, and points that nothing uses.
        parts.box(0, 4, 1);
        const int at = parts.points();
        parts.xyz.insert(parts.xyz.end(), {1, 1, 1, 3, 3, 3, 2, 2, 3, 9, 9, 9, 1, 3, 1});
        parts.facets.push_back({{at, at + 1}});
        parts.facets.push_back({{at + 2}});
        parts.facet_markers.insert(parts.facet_markers.end(), {8, 8});
        parts.point_markers.assign(static_cast<std::size_t>(parts.points()), 0);
        parts.point_markers[static_cast<std::size_t>(at) + 3] = 99;
        parts.point_markers[static_cast<std::size_t>(at) + 4] = 98;
    } else if (name == "sized") {
        parts.box(0, 2, 11);
        parts.sizes = {0.3, 1, 1, 1, 1, 1, 1, 1};
    } else if (name == "bounded") { // Bounds of a facet and of a segment.
        parts.box(0, 2, 11);
        parts.facet_bounds = {11, 0.05};
        parts.segment_bounds = {6, 7, 0.2};
    } else if (name == "crossing") { // Two boxes that cut each other.
        parts.box(0, 2, 1);
        parts.box(1, 3, 11);
        parts.triangles();
    } else if (name == "open") { // A box without its lid.
        parts.box(0, 2, 1);
        parts.facets.pop_back();
        parts.facet_markers.pop_back();
    } else if (name == "twisted") { // Schoenhardt's polyhedron: no tetrahedralization without added points.
        parts.xyz = {0, 0, 0, 4, 0, 0, 2, 3, 0, 1, -1, 4, 4, 1.5, 4, 0.5, 2.5, 4};
        const int corners[8][3] = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
        for (const int *c : corners)
            parts.facets.push_back({{c[0], c[1], c[2]}});
    } else if (name == "points" || name == "weights") {
        std::uint64_t seed = 7;
        for (int i = 0; i < 90; i++) {
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            parts.xyz.push_back(static_cast<double>(seed >> 40) / 16777216.0);
        }
        if (name == "weights")
            for (int i = 0; i < 30; i++)
                parts.attributes.push_back(0.01 * (i % 5));
    } else if (name == "six") { // A point inside of five.
        parts.xyz = {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4, 3, 3, 3, 1, 1, 1};
    } else if (name == "weighted") { // The same; the point inside counts for less.
        parts.xyz = {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4, 3, 3, 3, 1, 1, 1};
        parts.attributes = {1, 0.5, 0.25, 0, 0.5, -9};
    } else if (name == "equal") { // A box with a point given twice.
        parts.box(0, 2, 11);
        parts.xyz.insert(parts.xyz.end(), {2, 2, 2, 1, 1, 1});
    } else if (name == "flat") {
        parts.xyz = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    } else if (name == "planar_flat") {
        parts.xyz = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
        parts.facets.push_back({{0, 1, 3, 2}});
    } else if (name == "bad_index") {
        parts.box(0, 2, 11);
        parts.facets[0][0][0] = 40;
    } else if (name == "stray_seed") {
        parts.box(0, 2, 11);
        parts.regions = {1, 1, 1, 5, 0.1, 7, 7, 7, 6, 0.1};
        parts.holes = {9, 9, 9};
    } else if (name == "twice") { // A triangle given twice.
        parts.box(0, 2, 11);
        parts.triangles();
        parts.facets.push_back(parts.facets[0]);
        parts.facet_markers.push_back(50);
    } else if (name == "degenerate") { // A triangle with an equal corner.
        parts.box(0, 2, 11);
        parts.triangles();
        parts.facets.push_back({{0, 1, 1}});
        parts.facet_markers.push_back(50);
    } else if (name == "fraction") { // An attribute that is no integer.
        parts.box(0, 2, 11);
        parts.regions = {1, 1, 1, 2.75, 0.1};
    } else if (name == "skeleton") { // Segments alone.
        parts.xyz = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
        parts.facets = {{{0, 1}}, {{1, 4}}};
    } else if (name == "outlines") { // A box of facets that are given as edges.
        parts.box(0, 2, 11);
        for (std::vector<std::vector<int>> &facet : parts.facets) {
            const std::vector<int> ring = facet[0];
            facet = {{ring[0], ring[1]}, {ring[1], ring[2]}, {ring[2], ring[3]}, {ring[3], ring[0]}};
        }
    } else if (name == "strip") { // Two coplanar triangles with a marker, and two with another one, in a wall of a box.
        parts.box(0, 2, 11);
        parts.triangles();
        parts.facet_markers = {1, 1, 2, 3, 4, 4, 4, 4, 4, 4, 4, 4};
    }
    return parts;
}

} // namespace models
#endif
