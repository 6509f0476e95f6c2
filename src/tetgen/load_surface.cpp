// Readers of .off, .ply and .stl, by the library's own, and of .mesh and .vtk.
#include "load.hpp"

#include <delotet/delotet.h>

#include <cstring>
#include <memory>

namespace delotet_tetgen {

namespace {

struct FreePlc {
    void operator()(DelotetPlc *plc) const { delotet_plc_free(plc); }
};

/// Reads a surface by its extension; the numbers of its points start at `first`.
bool read_surface(const std::string &path, int first, tetgenio &io)
{
    DelotetPlc *read = NULL;
    DelotetError *error = NULL;
    if (delotet_plc_read(path.c_str(), &read, &error) != DELOTET_STATUS_OK) {
        std::fprintf(stderr, "%s\n", delotet_error_message(error));
        delotet_error_free(error);
        return false;
    }
    const std::unique_ptr<DelotetPlc, FreePlc> plc(read);
    Points points;
    points.first = first;
    const DelotetPointsView xyz = delotet_plc_points(read);
    if (xyz.count != 0)
        points.xyz.assign(xyz.data, xyz.data + 3 * xyz.count);
    Facets facets;
    const std::size_t count = delotet_plc_facet_count(read);
    std::vector<int> polygon;
    for (std::uint32_t i = 0; i < count; i++) {
        facets.add();
        for (std::size_t j = 0; j < delotet_plc_facet_ring_count(read, i); j++) {
            const DelotetIndicesView ring = delotet_plc_facet_ring(read, i, j);
            polygon.clear();
            for (std::size_t k = 0; k < ring.count; k++)
                polygon.push_back(static_cast<int>(ring.data[k]) + first);
            facets.add_polygon(polygon);
        }
    }
    use_points(io, points);
    facets.use(io);
    return true;
}

/// A kind of element of .mesh: its keyword and number of corners.
struct Kind {
    const char *word;
    int corners;
};

constexpr Kind triangle = {"Triangles", 3};
constexpr Kind quadrilateral = {"Quadrilaterals", 4};
constexpr Kind tetrahedron = {"Tetrahedra", 4};
constexpr Kind edge = {"Edges", 2};

/// What .mesh has of one kind.
struct Section {
    std::vector<int> corners;
    std::vector<int> references;
};

bool read_section(Lines &lines, const Kind &kind, Section &section)
{
    int count = 0;
    if (!lines.number_ahead(count) || count < 0)
        return lines.fault("the number of elements is missing");
    for (int i = 0; i < count; i++) {
        for (int j = 0; j <= kind.corners; j++) {
            int value = 0;
            if (!lines.number_ahead(value))
                return lines.fault("an element is incomplete");
            (j == kind.corners ? section.references : section.corners).push_back(value);
        }
    }
    return true;
}

/// The content of a .mesh file.
struct Medit {
    Points points;
    Section triangles, quadrilaterals, tets, edges;
};

bool read_vertices(Lines &lines, int dimension, Points &points)
{
    int count = 0, reference = 0;
    if (!lines.number_ahead(count) || count < 0)
        return lines.fault("the number of vertices is missing");
    for (int i = 0; i < count; i++) {
        double xyz[3] = {0.0, 0.0, 0.0};
        for (int j = 0; j < dimension; j++)
            if (!lines.number_ahead(xyz[j]))
                return lines.fault("a vertex is incomplete");
        if (!lines.number_ahead(reference))
            return lines.fault("a vertex has no reference");
        points.xyz.insert(points.xyz.end(), xyz, xyz + 3);
    }
    return true;
}

bool read_medit(Lines &lines, Medit &medit)
{
    int dimension = 3;
    std::string word;
    medit.points.first = 1;
    // What is not known is passed over, word by word.
    while (lines.word_ahead(word)) {
        bool good = true;
        if (word == "End")
            break;
        if (word == "Dimension")
            good = (lines.number_ahead(dimension) && (dimension == 2 || dimension == 3)) ||
                   lines.fault("the dimension is 2 or 3");
        else if (word == "Vertices")
            good = read_vertices(lines, dimension, medit.points);
        else if (word == triangle.word)
            good = read_section(lines, triangle, medit.triangles);
        else if (word == quadrilateral.word)
            good = read_section(lines, quadrilateral, medit.quadrilaterals);
        else if (word == tetrahedron.word)
            good = read_section(lines, tetrahedron, medit.tets);
        else if (word == edge.word)
            good = read_section(lines, edge, medit.edges);
        if (!good)
            return false;
    }
    if (medit.points.xyz.empty())
        return lines.fault("there are no vertices");
    return true;
}

void add_polygons(const Section &section, int corners, Facets &facets)
{
    for (std::size_t i = 0; i < section.references.size(); i++) {
        const int *first = &section.corners[i * static_cast<std::size_t>(corners)];
        facets.add();
        facets.add_polygon(std::vector<int>(first, first + corners));
        facets.markers.push_back(section.references[i]);
    }
}

void use_medit(tetgenio &io, const Medit &medit, bool mesh)
{
    use_points(io, medit.points);
    if (!medit.tets.references.empty()) {
        replace(io.tetrahedronlist, medit.tets.corners);
        replace(io.tetrahedronattributelist,
                std::vector<double>(medit.tets.references.begin(), medit.tets.references.end()));
        io.numberoftetrahedra = static_cast<int>(medit.tets.references.size());
        io.numberofcorners = 4;
        io.numberoftetrahedronattributes = 1;
    }
    if (mesh) {
        replace(io.trifacelist, medit.triangles.corners);
        replace(io.trifacemarkerlist, medit.triangles.references);
        io.numberoftrifaces = static_cast<int>(medit.triangles.references.size());
        replace(io.edgelist, medit.edges.corners);
        replace(io.edgemarkerlist, medit.edges.references);
        io.numberofedges = static_cast<int>(medit.edges.references.size());
        return;
    }
    Facets facets;
    add_polygons(medit.triangles, 3, facets);
    add_polygons(medit.quadrilaterals, 4, facets);
    facets.use(io);
}

/// Reads the polygons of a legacy VTK file in text: POLYGONS of a surface, or the cells of a grid that are polygons.
bool read_cells(Lines &lines, std::vector<std::vector<int>> &cells)
{
    int count = 0, size = 0;
    if (!lines.number_ahead(count) || !lines.number_ahead(size) || count < 0)
        return lines.fault("the number of cells is missing");
    for (int i = 0; i < count; i++) {
        int corners = 0, corner = 0;
        if (!lines.number_ahead(corners) || corners < 0)
            return lines.fault("a cell is incomplete");
        cells.emplace_back();
        for (int j = 0; j < corners; j++) {
            if (!lines.number_ahead(corner))
                return lines.fault("a cell is incomplete");
            cells.back().push_back(corner);
        }
    }
    return true;
}

bool read_types(Lines &lines, const std::vector<std::vector<int>> &cells, Facets &facets)
{
    int count = 0, type = 0;
    if (!lines.number_ahead(count) || count < 0 || static_cast<std::size_t>(count) != cells.size())
        return lines.fault("the number of types is not that of the cells");
    for (const std::vector<int> &cell : cells) {
        if (!lines.number_ahead(type))
            return lines.fault("a cell has no type");
        // Triangles, polygons and quadrilaterals.
        if ((type == 5 || type == 7 || type == 9) && !cell.empty()) {
            facets.add();
            facets.add_polygon(cell);
        }
    }
    return true;
}

bool read_vtk(Lines &lines, Points &points, Facets &facets)
{
    std::string word;
    std::vector<std::vector<int>> cells;
    int count = 0;
    while (lines.word_ahead(word)) {
        bool good = true;
        if (word == "BINARY")
            return lines.fault("only .vtk files in text can be read");
        if (word == "POINTS") {
            if (!lines.number_ahead(count) || count < 0 || !lines.word_ahead(word))
                return lines.fault("the number of points is missing");
            for (int i = 0; i < count; i++) {
                double xyz[3];
                if (!lines.number_ahead(xyz[0]) || !lines.number_ahead(xyz[1]) || !lines.number_ahead(xyz[2]))
                    return lines.fault("a point is incomplete");
                points.xyz.insert(points.xyz.end(), xyz, xyz + 3);
            }
        } else if (word == "POLYGONS") {
            std::vector<std::vector<int>> polygons;
            good = read_cells(lines, polygons);
            for (const std::vector<int> &polygon : polygons) {
                facets.add();
                facets.add_polygon(polygon);
            }
        } else if (word == "CELLS") {
            good = read_cells(lines, cells);
        } else if (word == "CELL_TYPES") {
            good = read_types(lines, cells, facets);
        }
        if (!good)
            return false;
    }
    if (points.xyz.empty())
        return lines.fault("there are no points");
    return true;
}

} // namespace
} // namespace delotet_tetgen

using namespace delotet_tetgen;

bool tetgenio::load_off(const char *filebasename)
{
    const std::string path = std::string(filebasename) + ".off";
    return attempt(path, [&] { return read_surface(path, 0, *this); });
}

bool tetgenio::load_ply(const char *filebasename)
{
    const std::string path = std::string(filebasename) + ".ply";
    return attempt(path, [&] { return read_surface(path, 0, *this); });
}

bool tetgenio::load_stl(const char *filebasename)
{
    const std::string path = std::string(filebasename) + ".stl";
    return attempt(path, [&] { return read_surface(path, 1, *this); });
}

bool tetgenio::load_medit(const char *filebasename, int istetmesh)
{
    return with_file(std::string(filebasename) + ".mesh", false, [&](Lines &lines) {
        Medit medit;
        if (!read_medit(lines, medit))
            return false;
        use_medit(*this, medit, istetmesh != 0);
        return true;
    });
}

bool tetgenio::load_vtk(const char *filebasename)
{
    return with_file(std::string(filebasename) + ".vtk", false, [&](Lines &lines) {
        Points points;
        Facets facets;
        if (!read_vtk(lines, points, facets))
            return false;
        use_points(*this, points);
        facets.use(*this);
        return true;
    });
}
