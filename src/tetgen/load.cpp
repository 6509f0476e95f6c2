// Readers of .node, .mtr, .ele, .face, .edge, .vol and .var, and of sets of these files.
//
// A reader changes the object only if the whole file can be read. Of files that go with others (.face, .mtr and so on) it is no fault that
// they do not exist.
#include "load.hpp"

#include <cstring>

namespace delotet_tetgen {

bool read_points(Lines &lines, Points &points)
{
    int count = 0, dimension = 3, marked = 0;
    if (!lines.number(count) || count < 0)
        return lines.fault("the number of points is missing");
    if (lines.number(dimension)) {
        if (lines.number(points.attributes))
            lines.number(marked);
    }
    if ((dimension != 2 && dimension != 3) || points.attributes < 0)
        return lines.fault("a header is: number of points, dimension 3, number of attributes, 0 or 1 for markers");
    points.marked = marked != 0;
    points.xyz.reserve(3 * believed(count));
    for (int i = 0; i < count; i++) {
        int index = 0;
        double xyz[3] = {0.0, 0.0, 0.0};
        if (!lines.next())
            return lines.fault("the list of points ends early");
        if (!lines.number(index))
            return lines.fault("a point has no number");
        if (i == 0)
            points.first = index == 1 ? 1 : 0;
        for (int j = 0; j < dimension; j++)
            if (!lines.number(xyz[j]))
                return lines.fault("a point lacks a coordinate");
        points.xyz.insert(points.xyz.end(), xyz, xyz + 3);
        for (int j = 0; j < points.attributes; j++) {
            double value = 0.0;
            if (!lines.number(value))
                return lines.fault("a point lacks an attribute");
            points.attribute.push_back(value);
        }
        if (points.marked) {
            int marker = 0;
            lines.number(marker);
            points.marker.push_back(marker);
        }
    }
    return true;
}

void use_points(tetgenio &io, const Points &points)
{
    double *xyz = to_array(points.xyz);
    double *attribute = NULL;
    int *marker = NULL;
    try {
        attribute = to_array(points.attribute);
        marker = to_array(points.marker);
    } catch (...) {
        delete[] xyz;
        delete[] attribute;
        throw;
    }
    delete[] io.pointlist;
    delete[] io.pointattributelist;
    delete[] io.pointmarkerlist;
    io.firstnumber = points.first;
    io.mesh_dim = 3;
    io.pointlist = xyz;
    io.pointattributelist = attribute;
    io.pointmarkerlist = marker;
    io.numberofpoints = points.count();
    io.numberofpointattributes = points.attributes;
}

namespace {

/// Lists of elements by their corners, such as .face and .edge have.
struct Elements {
    std::vector<int> corners;
    std::vector<int> marker;
    int count = 0;
};

/// Reads elements of `corners` corners, with or without markers.
bool read_elements(Lines &lines, int corners, Elements &elements)
{
    int marked = 0;
    if (!lines.count(elements.count))
        return lines.fault("the number of elements is missing");
    lines.number(marked);
    elements.corners.reserve(static_cast<std::size_t>(corners) * believed(elements.count));
    for (int i = 0; i < elements.count; i++) {
        int index = 0, corner = 0;
        if (!lines.next())
            return lines.fault("the list ends early");
        if (!lines.number(index))
            return lines.fault("an element has no number");
        for (int j = 0; j < corners; j++) {
            if (!lines.number(corner))
                return lines.fault("an element lacks a corner");
            elements.corners.push_back(corner);
        }
        if (marked != 0) {
            int marker = 0;
            lines.number(marker);
            elements.marker.push_back(marker);
        }
    }
    return true;
}

bool read_tets(Lines &lines, tetgenio &io)
{
    int count = 0, corners = 4, attributes = 0;
    if (!lines.count(count))
        return lines.fault("the number of tetrahedra is missing");
    if (lines.number(corners))
        lines.number(attributes);
    if ((corners != 4 && corners != 10) || attributes < 0)
        return lines.fault("a header is: number of tetrahedra, 4 or 10 nodes each, number of attributes");
    std::vector<int> corner;
    std::vector<double> attribute;
    corner.reserve(static_cast<std::size_t>(corners) * believed(count));
    for (int i = 0; i < count; i++) {
        int index = 0;
        if (!lines.next())
            return lines.fault("the list of tetrahedra ends early");
        if (!lines.number(index))
            return lines.fault("a tetrahedron has no number");
        for (int j = 0; j < corners; j++) {
            if (!lines.number(index))
                return lines.fault("a tetrahedron lacks a corner");
            corner.push_back(index);
        }
        for (int j = 0; j < attributes; j++) {
            double value = 0.0;
            if (!lines.number(value))
                return lines.fault("a tetrahedron lacks an attribute");
            attribute.push_back(value);
        }
    }
    replace(io.tetrahedronlist, corner);
    replace(io.tetrahedronattributelist, attribute);
    io.numberoftetrahedra = count;
    io.numberofcorners = corners;
    io.numberoftetrahedronattributes = attributes;
    return true;
}

bool read_volumes(Lines &lines, tetgenio &io)
{
    int count = 0;
    if (!lines.count(count))
        return lines.fault("the number of volumes is missing");
    if (count != io.numberoftetrahedra)
        return lines.fault("the number of volumes is not that of the tetrahedra");
    std::vector<double> volumes;
    for (int i = 0; i < count; i++) {
        int index = 0;
        double volume = -1.0;
        if (!lines.next() || !lines.number(index))
            return lines.fault("the list of volumes ends early");
        lines.number(volume);
        volumes.push_back(volume);
    }
    replace(io.tetrahedronvolumelist, volumes);
    return true;
}

bool read_metrics(Lines &lines, tetgenio &io)
{
    int count = 0, width = 1;
    if (!lines.count(count))
        return lines.fault("the number of sizes is missing");
    lines.number(width);
    if (count != io.numberofpoints)
        return lines.fault("the number of sizes is not that of the points");
    if (width != 1 && width != 3 && width != 6)
        return lines.fault("there are 1, 3 or 6 sizes for a point");
    std::vector<double> sizes;
    for (int i = 0; i < count; i++) {
        if (!lines.next())
            return lines.fault("the list of sizes ends early");
        for (int j = 0; j < width; j++) {
            double size = 0.0;
            if (!lines.number(size))
                return lines.fault("a point has no size");
            sizes.push_back(size);
        }
    }
    replace(io.pointmtrlist, sizes);
    io.numberofpointmtrs = count == 0 ? 0 : width;
    return true;
}

/// One of the lists of .var: an index, which is dropped, and `width` numbers each.
bool read_constraints(Lines &lines, int width, int &count, std::vector<double> &list)
{
    if (!lines.next())
        return true;
    if (!lines.number(count) || count < 0)
        return lines.fault("the number of constraints is missing");
    for (int i = 0; i < count; i++) {
        int index = 0;
        if (!lines.next() || !lines.number(index))
            return lines.fault("the list of constraints ends early");
        for (int j = 0; j < width; j++) {
            double value = 0.0;
            if (!lines.number(value))
                return lines.fault("a constraint lacks a number");
            list.push_back(value);
        }
    }
    return true;
}

bool read_variable(Lines &lines, tetgenio &io)
{
    int facets = 0, segments = 0;
    std::vector<double> areas, lengths;
    if (!read_constraints(lines, 2, facets, areas) || !read_constraints(lines, 3, segments, lengths))
        return false;
    if (facets > 0) {
        replace(io.facetconstraintlist, areas);
        io.numberoffacetconstraints = facets;
    }
    if (segments > 0) {
        replace(io.segmentconstraintlist, lengths);
        io.numberofsegmentconstraints = segments;
    }
    return true;
}

} // namespace
} // namespace delotet_tetgen

using namespace delotet_tetgen;

bool tetgenio::load_node(const char *filebasename)
{
    return with_file(std::string(filebasename) + ".node", false, [&](Lines &lines) {
        Points points;
        if (!lines.next())
            return lines.fault("there are no points");
        if (!read_points(lines, points))
            return false;
        use_points(*this, points);
        return true;
    });
}

bool tetgenio::load_tet(const char *filebasename)
{
    return with_file(std::string(filebasename) + ".ele", false, [&](Lines &lines) { return read_tets(lines, *this); });
}

bool tetgenio::load_vol(const char *filebasename)
{
    return with_file(std::string(filebasename) + ".vol", true,
                     [&](Lines &lines) { return read_volumes(lines, *this); });
}

bool tetgenio::load_mtr(const char *filebasename)
{
    return with_file(std::string(filebasename) + ".mtr", true,
                     [&](Lines &lines) { return read_metrics(lines, *this); });
}

bool tetgenio::load_var(const char *filebasename)
{
    return with_file(std::string(filebasename) + ".var", true,
                     [&](Lines &lines) { return read_variable(lines, *this); });
}

bool tetgenio::load_face(const char *filebasename)
{
    return with_file(std::string(filebasename) + ".face", true, [&](Lines &lines) {
        Elements faces;
        if (!read_elements(lines, 3, faces))
            return false;
        replace(trifacelist, faces.corners);
        replace(trifacemarkerlist, faces.marker);
        numberoftrifaces = faces.count;
        return true;
    });
}

bool tetgenio::load_edge(const char *filebasename)
{
    return with_file(std::string(filebasename) + ".edge", true, [&](Lines &lines) {
        Elements edges;
        if (!read_elements(lines, 2, edges))
            return false;
        replace(edgelist, edges.corners);
        replace(edgemarkerlist, edges.marker);
        numberofedges = edges.count;
        return true;
    });
}

namespace {

bool exists(const char *base, const char *extension)
{
    std::FILE *file = std::fopen((std::string(base) + extension).c_str(), "rb");
    if (file != NULL)
        std::fclose(file);
    return file != NULL;
}

/// Reads a file that may be missing, but not be wrong.
bool companion(tetgenio &io, const char *base, const char *extension, bool (tetgenio::*load)(const char *))
{
    return !exists(base, extension) || (io.*load)(base);
}

} // namespace

bool tetgenio::load_plc(const char *filebasename, int object)
{
    bool good = false;
    switch (object) {
    case tetgenbehavior::NODES: good = load_node(filebasename); break;
    case tetgenbehavior::POLY: good = load_poly(filebasename); break;
    case tetgenbehavior::OFF: good = load_off(filebasename); break;
    case tetgenbehavior::PLY: good = load_ply(filebasename); break;
    case tetgenbehavior::STL: good = load_stl(filebasename); break;
    case tetgenbehavior::MEDIT: good = load_medit(filebasename, 0); break;
    case tetgenbehavior::VTK: good = load_vtk(filebasename); break;
    default: good = load_poly(filebasename); break;
    }
    if (!good)
        return false;
    // Files of these names beside other formats are not theirs.
    const bool poly = object == tetgenbehavior::POLY || object == tetgenbehavior::NODES;
    return (!poly || companion(*this, filebasename, ".edge", &tetgenio::load_edge)) &&
           companion(*this, filebasename, ".mtr", &tetgenio::load_mtr) &&
           companion(*this, filebasename, ".var", &tetgenio::load_var);
}

bool tetgenio::load_tetmesh(const char *filebasename, int object)
{
    if (object == tetgenbehavior::NEU_MESH) {
        std::fprintf(stderr, "%s: .neu is not supported\n", filebasename);
        return false;
    }
    if (object == tetgenbehavior::MEDIT)
        return load_medit(filebasename, 1) && companion(*this, filebasename, ".vol", &tetgenio::load_vol) &&
               companion(*this, filebasename, ".var", &tetgenio::load_var) &&
               companion(*this, filebasename, ".mtr", &tetgenio::load_mtr);
    return load_node(filebasename) && load_tet(filebasename) &&
           companion(*this, filebasename, ".face", &tetgenio::load_face) &&
           companion(*this, filebasename, ".edge", &tetgenio::load_edge) &&
           companion(*this, filebasename, ".vol", &tetgenio::load_vol) &&
           companion(*this, filebasename, ".var", &tetgenio::load_var) &&
           companion(*this, filebasename, ".mtr", &tetgenio::load_mtr);
}
