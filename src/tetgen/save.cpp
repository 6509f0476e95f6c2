// Writers of .node, .ele, .face, .edge, .neigh and what goes with them.
//
// Parsers of these files are primitive: the header is the first line, with the numbers that belong there and no others; no line is left
// out; a comment comes only at the end.
#include "save.hpp"

#include <charconv>
#include <cstring>

namespace delotet_tetgen {

namespace {
constexpr std::size_t chunk = 1 << 16;
}

Text::Text(const std::string &path, bool append) : path_(path), file_(std::fopen(path.c_str(), append ? "ab" : "wb"))
{
    failed_ = file_ == NULL;
}

Text::~Text()
{
    if (file_ != NULL)
        std::fclose(file_);
}

void Text::append(const char *text, std::size_t length)
{
    pending_.append(text, length);
    if (pending_.size() < chunk || failed_)
        return;
    failed_ = std::fwrite(pending_.data(), 1, pending_.size(), file_) != pending_.size();
    pending_.clear();
}

Text &Text::operator<<(const char *text)
{
    append(text, strlen(text));
    return *this;
}

Text &Text::operator<<(int value)
{
    char text[16];
    append(text, static_cast<std::size_t>(std::to_chars(text, text + sizeof(text), value).ptr - text));
    return *this;
}

Text &Text::operator<<(double value)
{
    char text[32];
    append(text, static_cast<std::size_t>(std::to_chars(text, text + sizeof(text), value).ptr - text));
    return *this;
}

Text &Text::column(int value, int width)
{
    char text[16];
    const std::ptrdiff_t length = std::to_chars(text, text + sizeof(text), value).ptr - text;
    for (std::ptrdiff_t i = length; i < width; i++)
        append(" ", 1);
    append(text, static_cast<std::size_t>(length));
    return *this;
}

bool Text::close()
{
    if (!failed_)
        failed_ = std::fwrite(pending_.data(), 1, pending_.size(), file_) != pending_.size();
    pending_.clear();
    if (file_ != NULL) {
        failed_ = std::fclose(file_) != 0 || failed_;
        file_ = NULL;
    }
    if (failed_)
        std::fprintf(stderr, "%s: cannot be written\n", path_.c_str());
    return !failed_;
}

namespace {

bool finish(Text &text, const Style &style)
{
    if (style.last != NULL)
        text << "# " << style.last << "\n";
    return text.close();
}

/// Rows of `width` numbers, each with its index.
void rows(Text &text, const tetgenio &io, const int *list, int count, int width)
{
    for (int i = 0; i < count; i++) {
        text.column(i + io.firstnumber, 5) << "  ";
        for (int j = 0; j < width; j++)
            text.column(list[static_cast<std::size_t>(i) * static_cast<std::size_t>(width) + static_cast<std::size_t>(j)], 6);
        text << "\n";
    }
}

/// The place of row `i` in a list of `width` numbers a row.
std::size_t row(int i, int width)
{
    return static_cast<std::size_t>(i) * static_cast<std::size_t>(width);
}

} // namespace

bool write_nodes(const tetgenio &io, const std::string &base, const Style &style)
{
    Text text(base + ".node");
    const bool marked = io.pointmarkerlist != NULL && !style.nobound;
    const int attributes = io.pointattributelist != NULL ? io.numberofpointattributes : 0;
    const int count = io.pointlist != NULL ? io.numberofpoints : 0;
    text << count << "  3  " << attributes << "  " << (marked ? 1 : 0) << "\n";
    for (int i = 0; i < count; i++) {
        const double *xyz = io.pointlist + row(i, 3);
        text.column(i + io.firstnumber, 4) << "    " << xyz[0] << "  " << xyz[1] << "  " << xyz[2];
        for (int j = 0; j < attributes; j++)
            text << "  " << io.pointattributelist[row(i, attributes) + static_cast<std::size_t>(j)];
        if (marked)
            text << "    " << io.pointmarkerlist[i];
        text << "\n";
    }
    return finish(text, style);
}

bool write_elements(const tetgenio &io, const std::string &base, const Style &style)
{
    Text text(base + ".ele");
    const int attributes = io.tetrahedronattributelist != NULL ? io.numberoftetrahedronattributes : 0;
    const int count = io.tetrahedronlist != NULL ? io.numberoftetrahedra : 0;
    text << count << "  " << io.numberofcorners << "  " << attributes << "\n";
    for (int i = 0; i < count; i++) {
        text.column(i + io.firstnumber, 5) << "  ";
        const int *corners = io.tetrahedronlist + row(i, io.numberofcorners);
        for (int j = 0; j < io.numberofcorners; j++)
            text.column(corners[j], 6);
        for (int j = 0; j < attributes; j++)
            text << "    " << io.tetrahedronattributelist[row(i, attributes) + static_cast<std::size_t>(j)];
        text << "\n";
    }
    return finish(text, style);
}

bool write_faces(const tetgenio &io, const std::string &base, const Style &style)
{
    Text text(base + ".face");
    const bool marked = io.trifacemarkerlist != NULL && !style.nobound;
    const int count = io.trifacelist != NULL ? io.numberoftrifaces : 0;
    text << count << "  " << (marked ? 1 : 0) << "\n";
    for (int i = 0; i < count; i++) {
        text.column(i + io.firstnumber, 5) << "  ";
        for (std::size_t j = 0; j < 3; j++)
            text.column(io.trifacelist[row(i, 3) + j], 6);
        for (std::size_t j = 0; j < 3 && io.o2facelist != NULL; j++)
            text.column(io.o2facelist[row(i, 3) + j], 6);
        if (marked)
            text << "  " << io.trifacemarkerlist[i];
        for (std::size_t j = 0; j < 2 && io.face2tetlist != NULL; j++)
            text.column(io.face2tetlist[row(i, 2) + j], 7);
        text << "\n";
    }
    return finish(text, style);
}

bool write_edges(const tetgenio &io, const std::string &base, const Style &style)
{
    Text text(base + ".edge");
    const bool marked = io.edgemarkerlist != NULL && !style.nobound;
    const int count = io.edgelist != NULL ? io.numberofedges : 0;
    text << count << "  " << (marked ? 1 : 0) << "\n";
    for (int i = 0; i < count; i++) {
        text.column(i + io.firstnumber, 5) << "  ";
        text.column(io.edgelist[row(i, 2)], 6).column(io.edgelist[row(i, 2) + 1], 6);
        if (io.o2edgelist != NULL)
            text.column(io.o2edgelist[i], 6);
        if (marked)
            text << "  " << io.edgemarkerlist[i];
        if (io.edge2tetlist != NULL)
            text << "  " << io.edge2tetlist[i];
        text << "\n";
    }
    return finish(text, style);
}

bool write_neighbors(const tetgenio &io, const std::string &base, const Style &style)
{
    Text text(base + ".neigh");
    text << io.numberoftetrahedra << "  4\n";
    rows(text, io, io.neighborlist, io.numberoftetrahedra, 4);
    return finish(text, style);
}

bool write_sizes(const tetgenio &io, const std::string &base)
{
    Text text(base + ".mtr");
    text << io.numberofpoints << "  " << io.numberofpointmtrs << "\n";
    for (int i = 0; i < io.numberofpoints; i++) {
        for (int j = 0; j < io.numberofpointmtrs; j++)
            text << io.pointmtrlist[row(i, io.numberofpointmtrs) + static_cast<std::size_t>(j)] << " ";
        text << "\n";
    }
    return text.close();
}

bool write_relations(const tetgenio &io, const std::string &base, const Style &style)
{
    struct Relation {
        const char *extension;
        const int *list;
        int count, width;
    };
    const Relation relations[] = {{".t2f", io.tet2facelist, io.numberoftetrahedra, 4},
                                  {".t2e", io.tet2edgelist, io.numberoftetrahedra, 6},
                                  {".f2e", io.face2edgelist, io.numberoftrifaces, 3}};
    bool good = true;
    for (const Relation &relation : relations) {
        if (relation.list == NULL)
            continue;
        // These files have no header.
        Text text(base + relation.extension);
        rows(text, io, relation.list, relation.count, relation.width);
        good = finish(text, style) && good;
    }
    return good;
}

bool write_voronoi(const tetgenio &io, const std::string &base, const Style &style)
{
    Text nodes(base + ".v.node");
    nodes << io.numberofvpoints << "  3  0  0\n";
    for (int i = 0; i < io.numberofvpoints; i++) {
        const double *xyz = io.vpointlist + row(i, 3);
        nodes.column(i + io.firstnumber, 4) << "    " << xyz[0] << "  " << xyz[1] << "  " << xyz[2] << "\n";
    }
    Text edges(base + ".v.edge");
    edges << io.numberofvedges << "  0\n";
    for (int i = 0; i < io.numberofvedges; i++) {
        const tetgenio::voroedge &edge = io.vedgelist[i];
        edges.column(i + io.firstnumber, 4) << "  ";
        edges.column(edge.v1, 4) << " ";
        edges.column(edge.v2, 4);
        if (edge.v2 == -1)
            edges << " " << edge.vnormal[0] << " " << edge.vnormal[1] << " " << edge.vnormal[2];
        edges << "\n";
    }
    // The lists of edges and facets have their length first; -1 closes one that is not bounded.
    Text facets(base + ".v.face");
    facets << io.numberofvfacets << "  0\n";
    for (int i = 0; i < io.numberofvfacets; i++) {
        const tetgenio::vorofacet &facet = io.vfacetlist[i];
        facets.column(i + io.firstnumber, 4) << "  ";
        facets.column(facet.c1, 4) << " ";
        facets.column(facet.c2, 4) << "  " << facet.elist[0] << "  ";
        for (int j = 1; j <= facet.elist[0]; j++)
            facets << " " << facet.elist[j];
        facets << "\n";
    }
    Text cells(base + ".v.cell");
    cells << io.numberofvcells << "\n";
    for (int i = 0; i < io.numberofvcells; i++) {
        const int *list = io.vcelllist[i];
        cells.column(i + io.firstnumber, 4) << "  " << list[0] << "  ";
        for (int j = 1; j <= list[0]; j++)
            cells << " " << list[j];
        cells << "\n";
    }
    const bool good[] = {finish(nodes, style), finish(edges, style), finish(facets, style), finish(cells, style)};
    return good[0] && good[1] && good[2] && good[3];
}

} // namespace delotet_tetgen
