// Writers of .mesh and .vtk, of .poly and .smesh, and of all files of a run.
#include "save.hpp"

#include <new>

namespace delotet_tetgen {

namespace {

std::size_t row(int i, int width)
{
    return static_cast<std::size_t>(i) * static_cast<std::size_t>(width);
}

/// An attribute as the reference of .mesh and the integer of .vtk.
int reference(const tetgenio &io, int tet)
{
    if (io.tetrahedronattributelist == NULL || io.numberoftetrahedronattributes < 1)
        return 0;
    const double value = io.tetrahedronattributelist[row(tet + 1, io.numberoftetrahedronattributes) - 1];
    return value > -2147483649.0 && value < 2147483648.0 ? static_cast<int>(value) : 0;
}

void vtk_head(Text &text, const tetgenio &io)
{
    text << "# vtk DataFile Version 2.0\nUnstructured Grid\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS " << io.numberofpoints
         << " double\n";
    for (int i = 0; i < io.numberofpoints; i++) {
        const double *xyz = io.pointlist + row(i, 3);
        text << xyz[0] << " " << xyz[1] << " " << xyz[2] << "\n";
    }
}

/// Cells of the first `corners` nodes of each row, and their type.
void vtk_cells(Text &text, const tetgenio &io, const int *list, int count, int width, int corners, int type)
{
    text << "\nCELLS " << count << " " << count * (corners + 1) << "\n";
    for (int i = 0; i < count; i++) {
        text << corners << " ";
        for (int j = 0; j < corners; j++)
            text.column(list[row(i, width) + static_cast<std::size_t>(j)] - io.firstnumber, 6);
        text << "\n";
    }
    text << "\nCELL_TYPES " << count << "\n";
    for (int i = 0; i < count; i++)
        text << type << "\n";
}

/// The number of the k-th corner in a file whose numbers start at 1.
int medit(const tetgenio &io, const int *list, int i, int width, int k)
{
    return list[row(i, width) + static_cast<std::size_t>(k)] - io.firstnumber + 1;
}

} // namespace

bool write_medit(const tetgenio &io, const std::string &base)
{
    Text text(base + ".mesh");
    text << "MeshVersionFormatted 1\n\nDimension\n3\n\nVertices\n" << io.numberofpoints << "\n";
    for (int i = 0; i < io.numberofpoints; i++) {
        const double *xyz = io.pointlist + row(i, 3);
        text << xyz[0] << "  " << xyz[1] << "  " << xyz[2] << "    " << (io.pointmarkerlist ? io.pointmarkerlist[i] : 0) << "\n";
    }
    text << "\nTriangles\n" << io.numberoftrifaces << "\n";
    for (int i = 0; i < io.numberoftrifaces; i++) {
        for (int j = 0; j < 3; j++)
            text.column(medit(io, io.trifacelist, i, 3, j), 5) << "  ";
        text << (io.trifacemarkerlist != NULL ? io.trifacemarkerlist[i] : 0) << "\n";
    }
    text << "\nTetrahedra\n" << io.numberoftetrahedra << "\n";
    for (int i = 0; i < io.numberoftetrahedra; i++) {
        for (int j = 0; j < 4; j++)
            text.column(medit(io, io.tetrahedronlist, i, io.numberofcorners, j), 5) << "  ";
        text << reference(io, i) << "\n";
    }
    if (io.edgelist != NULL) {
        text << "\nEdges\n" << io.numberofedges << "\n";
        for (int i = 0; i < io.numberofedges; i++) {
            text.column(medit(io, io.edgelist, i, 2, 0), 5) << "  ";
            text.column(medit(io, io.edgelist, i, 2, 1), 5) << "  ";
            text << (io.edgemarkerlist != NULL ? io.edgemarkerlist[i] : 0) << "\n";
        }
    }
    text << "\nEnd\n";
    return text.close();
}

bool write_vtk(const tetgenio &io, const std::string &base)
{
    Text text(base + ".vtk");
    vtk_head(text, io);
    vtk_cells(text, io, io.tetrahedronlist, io.numberoftetrahedra, io.numberofcorners, 4, 10);
    if (io.tetrahedronattributelist != NULL && io.numberoftetrahedronattributes > 0) {
        text << "\nCELL_DATA " << io.numberoftetrahedra << "\nSCALARS cell_scalars int 1\nLOOKUP_TABLE default\n";
        for (int i = 0; i < io.numberoftetrahedra; i++)
            text << reference(io, i) << "\n";
    }
    text << "\n";
    return text.close();
}

bool write_surface_vtk(const tetgenio &io, const std::string &base)
{
    Text text(base + ".surf.vtk");
    vtk_head(text, io);
    vtk_cells(text, io, io.trifacelist, io.numberoftrifaces, 3, 3, 5);
    if (io.trifacemarkerlist != NULL) {
        text << "\nCELL_DATA " << io.numberoftrifaces << "\nSCALARS cell_scalars int 1\nLOOKUP_TABLE default\n";
        for (int i = 0; i < io.numberoftrifaces; i++)
            text << io.trifacemarkerlist[i] << "\n";
    }
    text << "\n";
    return text.close();
}

bool write_poly(const tetgenio &io, const std::string &base)
{
    // The points are in a file of their own.
    Text text(base + ".poly");
    text << "0  3  " << io.numberofpointattributes << "  " << (io.pointmarkerlist != NULL ? 1 : 0) << "\n";
    const int facets = io.facetlist != NULL ? io.numberoffacets : 0;
    text << facets << "  " << (io.facetmarkerlist != NULL ? 1 : 0) << "\n";
    for (int i = 0; i < facets; i++) {
        const tetgenio::facet &facet = io.facetlist[i];
        const int holes = facet.holelist != NULL ? facet.numberofholes : 0;
        const int polygons = facet.polygonlist != NULL ? facet.numberofpolygons : 0;
        text << polygons << "  " << holes << "  "
             << (io.facetmarkerlist != NULL ? io.facetmarkerlist[i] : 0) << "\n";
        for (int j = 0; j < polygons; j++) {
            const tetgenio::polygon &polygon = facet.polygonlist[j];
            const int corners = polygon.vertexlist != NULL ? polygon.numberofvertices : 0;
            text << corners << "  ";
            for (int k = 0; k < corners; k++)
                text << "  " << polygon.vertexlist[k] << (k % 10 == 9 && k + 1 < corners ? "\n" : "");
            text << "\n";
        }
        for (int j = 0; j < holes; j++) {
            const double *seed = facet.holelist + row(j, 3);
            text << j + io.firstnumber << "  " << seed[0] << "  " << seed[1] << "  " << seed[2] << "\n";
        }
    }
    const int holes = io.holelist != NULL ? io.numberofholes : 0;
    text << holes << "\n";
    for (int i = 0; i < holes; i++) {
        const double *seed = io.holelist + row(i, 3);
        text << i + io.firstnumber << "  " << seed[0] << "  " << seed[1] << "  " << seed[2] << "\n";
    }
    const int regions = io.regionlist != NULL ? io.numberofregions : 0;
    text << regions << "\n";
    for (int i = 0; i < regions; i++) {
        const double *seed = io.regionlist + row(i, 5);
        text << i + io.firstnumber << "  " << seed[0] << "  " << seed[1] << "  " << seed[2] << "  " << seed[3] << "  " << seed[4]
             << "\n";
    }
    return text.close();
}

bool write_smesh(const tetgenio &io, const std::string &base)
{
    Text text(base + ".smesh");
    const int faces = io.trifacelist != NULL ? io.numberoftrifaces : 0;
    text << "0  3  0  0\n" << faces << "  " << (io.trifacemarkerlist != NULL ? 1 : 0) << "\n";
    for (int i = 0; i < faces; i++) {
        const int *corners = io.trifacelist + row(i, 3);
        text << "3  " << corners[0] << "  " << corners[1] << "  " << corners[2];
        if (io.trifacemarkerlist != NULL)
            text << "  " << io.trifacemarkerlist[i];
        text << "\n";
    }
    text << "0\n0\n";
    return text.close();
}

bool write_files(const tetgenbehavior &switches, const tetgenio &out, std::FILE *told)
{
    // The name that parse_commandline() gives to what has none, if it was not called.
    const std::string base = switches.outfilename[0] != '\0' ? switches.outfilename : "tetgen-tmpfile.1";
    const std::string last = std::string("Generated by ") + switches.commandline;
    Style style;
    style.nobound = switches.nobound != 0;
    style.last = last.c_str();
    bool good = true;
    const auto file = [&](const char *extension, bool written) {
        good = good && written;
        if (told != NULL && written)
            std::fprintf(told, "Writing %s%s.\n", base.c_str(), extension);
    };
    if (!switches.nonodewritten && out.pointlist != NULL)
        file(".node", write_nodes(out, base, style));
    if (switches.metric && out.pointmtrlist != NULL && !switches.nonodewritten)
        file(".mtr", write_sizes(out, base));
    if (!switches.noelewritten && out.tetrahedronlist != NULL)
        file(".ele", write_elements(out, base, style));
    if (!switches.nofacewritten && out.trifacelist != NULL)
        file(".face", write_faces(out, base, style));
    if (!switches.nofacewritten && out.edgelist != NULL)
        file(".edge", write_edges(out, base, style));
    if (switches.meditview && out.tetrahedronlist != NULL)
        file(".mesh", write_medit(out, base));
    if (switches.vtkview && out.tetrahedronlist != NULL)
        file(".vtk", write_vtk(out, base));
    if (switches.vtksurfview && out.trifacelist != NULL)
        file(".surf.vtk", write_surface_vtk(out, base));
    if (switches.neighout && out.neighborlist != NULL)
        file(".neigh", write_neighbors(out, base, style));
    if (switches.neighout > 1)
        good = write_relations(out, base, style) && good;
    if (switches.voroout && out.vpointlist != NULL)
        file(".v.node, .v.edge, .v.face, .v.cell", write_voronoi(out, base, style));
    return good;
}

namespace {

/// Calls a writer; memory that runs out is a failure like others.
template <class Write> void save(const char *base, Write write)
{
    try {
        write(std::string(base));
    } catch (const std::bad_alloc &) {
        std::fprintf(stderr, "%s: memory ran out\n", base);
    }
}

} // namespace
} // namespace delotet_tetgen

using namespace delotet_tetgen;

void tetgenio::save_nodes(const char *filebasename)
{
    save(filebasename, [this](const std::string &base) { write_nodes(*this, base, Style()); });
}

void tetgenio::save_elements(const char *filebasename)
{
    save(filebasename, [this](const std::string &base) { write_elements(*this, base, Style()); });
}

void tetgenio::save_faces(const char *filebasename)
{
    save(filebasename, [this](const std::string &base) { write_faces(*this, base, Style()); });
}

void tetgenio::save_edges(const char *filebasename)
{
    save(filebasename, [this](const std::string &base) { write_edges(*this, base, Style()); });
}

void tetgenio::save_neighbors(const char *filebasename)
{
    if (neighborlist != NULL)
        save(filebasename, [this](const std::string &base) { write_neighbors(*this, base, Style()); });
}

void tetgenio::save_poly(const char *filebasename)
{
    save(filebasename, [this](const std::string &base) { write_poly(*this, base); });
}

void tetgenio::save_faces2smesh(const char *filebasename)
{
    save(filebasename, [this](const std::string &base) { write_smesh(*this, base); });
}
