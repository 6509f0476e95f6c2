// Readers of .poly and .smesh.
#include "load.hpp"

namespace delotet_tetgen {

void Facets::use(tetgenio &io) const
{
    // An object of its own frees what was made if memory runs out, and then what `io` had.
    tetgenio made;
    if (!list_.empty()) {
        made.facetlist = new tetgenio::facet[list_.size()];
        made.numberoffacets = static_cast<int>(list_.size());
    }
    for (std::size_t i = 0; i < list_.size(); i++) {
        tetgenio::facet &facet = made.facetlist[i];
        const Facet &read = list_[i];
        facet.holelist = to_array(read.holes);
        facet.numberofholes = static_cast<int>(read.holes.size() / 3);
        if (read.polygons.empty())
            continue;
        facet.polygonlist = new tetgenio::polygon[read.polygons.size()];
        facet.numberofpolygons = static_cast<int>(read.polygons.size());
        for (std::size_t j = 0; j < read.polygons.size(); j++) {
            facet.polygonlist[j].vertexlist = to_array(read.polygons[j]);
            facet.polygonlist[j].numberofvertices = static_cast<int>(read.polygons[j].size());
        }
    }
    made.facetmarkerlist = to_array(markers);
    std::swap(io.facetlist, made.facetlist);
    std::swap(io.numberoffacets, made.numberoffacets);
    std::swap(io.facetmarkerlist, made.facetmarkerlist);
}

namespace {

/// Reads a polygon whose number of corners is the next field; it may go over several lines.
bool read_polygon(Lines &lines, Facets &facets)
{
    int corners = 0;
    if (!lines.number(corners) || corners < 1)
        return lines.fault("the number of corners of a polygon is missing");
    std::vector<int> polygon;
    for (int i = 0; i < corners; i++) {
        int corner = 0;
        if (!lines.number_ahead(corner))
            return lines.fault("a polygon lacks a corner");
        polygon.push_back(corner);
    }
    facets.add_polygon(polygon);
    return true;
}

/// Reads a facet of .poly: polygons, and seeds of its holes.
bool read_facet(Lines &lines, bool marked, Facets &facets)
{
    int polygons = 0, holes = 0, marker = 0;
    if (!lines.count(polygons))
        return lines.fault("the number of polygons of a facet is missing");
    if (lines.number(holes))
        lines.number(marker);
    facets.add();
    if (marked)
        facets.markers.push_back(marker);
    for (int i = 0; i < polygons; i++) {
        if (!lines.next())
            return lines.fault("a facet ends early");
        if (!read_polygon(lines, facets))
            return false;
    }
    for (int i = 0; i < holes; i++) {
        int index = 0;
        double seed[3];
        if (!lines.next() || !lines.number(index) || !lines.number(seed[0]) || !lines.number(seed[1]) ||
            !lines.number(seed[2]))
            return lines.fault("the hole of a facet is: a number and three coordinates");
        facets.add_hole(seed);
    }
    return true;
}

bool read_facets(Lines &lines, bool simple, Facets &facets)
{
    int count = 0, marked = 0;
    if (!lines.count(count))
        return lines.fault("the number of facets is missing");
    lines.number(marked);
    for (int i = 0; i < count; i++) {
        if (!simple) {
            if (!read_facet(lines, marked != 0, facets))
                return false;
            continue;
        }
        int marker = 0;
        if (!lines.next())
            return lines.fault("the list of facets ends early");
        facets.add();
        if (!read_polygon(lines, facets))
            return false;
        lines.number(marker);
        if (marked != 0)
            facets.markers.push_back(marker);
    }
    return true;
}

/// Reads the seeds of holes, if the file goes on.
bool read_holes(Lines &lines, std::vector<double> &holes)
{
    int count = 0, index = 0;
    if (!lines.next())
        return true;
    if (!lines.number(count) || count < 0)
        return lines.fault("the number of holes is missing");
    for (int i = 0; i < count; i++) {
        double seed[3];
        if (!lines.next() || !lines.number(index) || !lines.number(seed[0]) || !lines.number(seed[1]) ||
            !lines.number(seed[2]))
            return lines.fault("a hole is: a number and three coordinates");
        holes.insert(holes.end(), seed, seed + 3);
    }
    return true;
}

/// Reads the seeds of regions, if the file goes on.
bool read_regions(Lines &lines, std::vector<double> &regions)
{
    int count = 0, index = 0;
    if (!lines.next())
        return true;
    if (!lines.number(count) || count < 0)
        return lines.fault("the number of regions is missing");
    for (int i = 0; i < count; i++) {
        double seed[5];
        if (!lines.next() || !lines.number(index) || !lines.number(seed[0]) || !lines.number(seed[1]) ||
            !lines.number(seed[2]) || !lines.number(seed[3]))
            return lines.fault("a region is: a number, three coordinates, an attribute, and a largest volume");
        // A single number is both, as TetGen has it.
        if (!lines.number(seed[4]))
            seed[4] = seed[3];
        regions.insert(regions.end(), seed, seed + 5);
    }
    return true;
}

/// Reads .poly or .smesh; with a list of no points, they are in the .node file of that name.
bool read_complex(Lines &lines, const std::string &base, bool simple, tetgenio &io)
{
    Points points;
    Facets facets;
    std::vector<double> holes, regions;
    if (!lines.next())
        return lines.fault("there are no points");
    if (!read_points(lines, points))
        return false;
    if (points.count() == 0) {
        Lines nodes(base + ".node");
        if (!nodes.opened())
            return lines.fault("there are no points, and no .node file");
        points = Points();
        if (!nodes.next())
            return nodes.fault("there are no points");
        if (!read_points(nodes, points))
            return false;
    }
    if (!read_facets(lines, simple, facets) || !read_holes(lines, holes) || !read_regions(lines, regions))
        return false;
    use_points(io, points);
    facets.use(io);
    replace(io.holelist, holes);
    io.numberofholes = static_cast<int>(holes.size() / 3);
    replace(io.regionlist, regions);
    io.numberofregions = static_cast<int>(regions.size() / 5);
    return true;
}

} // namespace
} // namespace delotet_tetgen

using namespace delotet_tetgen;

bool tetgenio::load_poly(const char *filebasename)
{
    const std::string base = filebasename;
    return attempt(base, [&] {
        Lines poly(base + ".poly");
        if (poly.opened())
            return read_complex(poly, base, false, *this);
        Lines smesh(base + ".smesh");
        if (smesh.opened())
            return read_complex(smesh, base, true, *this);
        std::fprintf(stderr, "%s.poly, %s.smesh: cannot be read\n", filebasename, filebasename);
        return false;
    });
}
