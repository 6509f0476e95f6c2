// Who owns what: sequences of initialize, load, tetrahedralize, save, deinitialize and copy, to be run under AddressSanitizer and valgrind;
// and the caller's arrays, which lie in memory that cannot be written.
#include <tetgen.h>

#include "check.hpp"

#include <sys/mman.h>

#include <cstring>
#include <string>
#include <vector>

namespace {

/// An array in pages that can only be read.
template <class T> class Sealed {
  public:
    explicit Sealed(const std::vector<T> &list) : bytes_((list.size() * sizeof(T) / 4096 + 1) * 4096)
    {
        void *pages = mmap(NULL, bytes_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        CHECK(pages != MAP_FAILED);
        std::memcpy(pages, list.data(), list.size() * sizeof(T));
        data = static_cast<T *>(pages);
    }
    ~Sealed() { munmap(data, bytes_); }
    Sealed(const Sealed &) = delete;
    Sealed &operator=(const Sealed &) = delete;
    void seal() { CHECK(mprotect(data, bytes_, PROT_READ) == 0); }

    T *data;

  private:
    std::size_t bytes_;
};

/// The string of switches, in memory that can be written, as clients have it.
int mesh(const char *switches, tetgenio *in, tetgenio *out, tetgenio *addin = NULL, tetgenio *bgmin = NULL)
{
    std::string copy = switches;
    return tetrahedralize(&copy[0], in, out, addin, bgmin);
}

const std::vector<double> corners = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1, 5, 5, 5};
const std::vector<int> sides = {0, 1, 3, 2, 4, 5, 7, 6, 0, 1, 5, 4, 2, 3, 7, 6, 0, 2, 6, 4, 1, 3, 7, 5};

/// A cube, with a point that belongs to nothing.
void fill(tetgenio &io)
{
    io.numberofpoints = static_cast<int>(corners.size() / 3);
    io.pointlist = new double[corners.size()];
    std::memcpy(io.pointlist, corners.data(), corners.size() * sizeof(double));
    io.numberoffacets = 6;
    io.facetlist = new tetgenio::facet[6];
    io.facetmarkerlist = new int[6];
    for (int i = 0; i < 6; i++) {
        io.facetmarkerlist[i] = i + 1;
        tetgenio::facet &facet = io.facetlist[i];
        facet.numberofpolygons = 1;
        facet.polygonlist = new tetgenio::polygon[1];
        facet.polygonlist[0].numberofvertices = 4;
        facet.polygonlist[0].vertexlist = new int[4];
        std::memcpy(facet.polygonlist[0].vertexlist, &sides[static_cast<std::size_t>(4 * i)], 4 * sizeof(int));
    }
}

/// The input lies in pages that are only read: arrays, facets, the object itself, and a literal as switches.
void nothing_is_written()
{
    Sealed<double> points(corners);
    Sealed<int> vertices(sides), markers({1, 2, 3, 4, 5, 6}), point_markers({1, 2, 3, 4, 5, 6, 7, 8, 9});
    Sealed<double> regions({0.5, 0.5, 0.5, 3, 0.05}), sizes(std::vector<double>(9, 0.4)), weights(std::vector<double>(18, 1.5));
    Sealed<tetgenio::polygon> polygons((std::vector<tetgenio::polygon>(6)));
    Sealed<tetgenio::facet> facets((std::vector<tetgenio::facet>(6)));
    for (int i = 0; i < 6; i++) {
        polygons.data[i].vertexlist = vertices.data + 4 * i;
        polygons.data[i].numberofvertices = 4;
        facets.data[i].polygonlist = polygons.data + i;
        facets.data[i].numberofpolygons = 1;
    }
    Sealed<char> room(std::vector<char>(sizeof(tetgenio)));
    tetgenio &in = *new (room.data) tetgenio;
    in.numberofpoints = 9;
    in.pointlist = points.data;
    in.pointmarkerlist = point_markers.data;
    in.pointattributelist = weights.data;
    in.numberofpointattributes = 2;
    in.pointmtrlist = sizes.data;
    in.numberofpointmtrs = 1;
    in.numberoffacets = 6;
    in.facetlist = facets.data;
    in.facetmarkerlist = markers.data;
    in.numberofregions = 1;
    in.regionlist = regions.data;
    points.seal();
    vertices.seal();
    markers.seal();
    point_markers.seal();
    regions.seal();
    sizes.seal();
    weights.seal();
    polygons.seal();
    facets.seal();
    room.seal();
    for (const char *switches : {"pQ", "pqQ", "pqaAQ", "pzQ", "pYQ", "pJnnfeo2Q", "pqmQ", "Q", "pcQ", "pdQ"}) {
        tetgenio out;
        CHECK(tetrahedralize(const_cast<char *>(switches), &in, &out) == 0);
        CHECK(std::strcmp(switches, "pdQ") == 0 || out.numberoftetrahedra > 0);
    }
    // What fails writes nothing either.
    for (const char *switches : {"prwQ", "rQ", "RpQ"}) {
        tetgenio out;
        int thrown = 0;
        try {
            tetrahedralize(const_cast<char *>(switches), &in, &out);
        } catch (int code) {
            thrown = code;
        }
        CHECK(thrown == 10);
    }
}

void ownership()
{
    // Forgotten arrays belong to whoever kept them.
    tetgenio in, out;
    fill(in);
    CHECK(mesh("pqQ", &in, &out) == 0);
    double *points = out.pointlist;
    int *tets = out.tetrahedronlist;
    tetgenio aside = out;
    out.initialize();
    CHECK(out.pointlist == NULL && out.numberofpoints == 0 && out.numberofcorners == 4);
    CHECK(aside.pointlist == points && aside.tetrahedronlist == tets);
    CHECK(points[0] < 2.0 && tets[0] >= 0);
    // A shallow copy of a filled object, of which one is cleared.
    tetgenio copy;
    copy = aside;
    aside.initialize();
    CHECK(copy.numberoftetrahedra > 0);
    copy.deinitialize();
    CHECK(copy.pointlist == NULL);
    copy.clean_memory();
    // An output is the input of the next call, as a shallow copy that is cleared, and as itself.
    CHECK(mesh("pqQ", &in, &out) == 0);
    tetgenio next = out, finer;
    CHECK(mesh("rqa0.01Q", &next, &finer) == 0);
    CHECK(finer.numberoftetrahedra > out.numberoftetrahedra);
    next.initialize();
    out.deinitialize();
    // Output on output: what was there is the caller's.
    double *old = finer.pointlist;
    tetgenio kept = finer;
    CHECK(mesh("pQ", &in, &finer) == 0);
    CHECK(finer.pointlist != old && old[0] < 2.0);
    // Pointers set to NULL stay the caller's; counts may be stale.
    int *markers = in.facetmarkerlist;
    in.facetmarkerlist = NULL;
    in.numberofholes = 7;
    in.deinitialize();
    delete[] markers;
    // Objects without content.
    tetgenio empty, result;
    int thrown = 0;
    try {
        mesh("Q", &empty, &result);
    } catch (int code) {
        thrown = code;
    }
    CHECK(thrown == 10 && result.pointlist == NULL);
    thrown = 0;
    try {
        tetrahedralize(static_cast<char *>(NULL), NULL, &result);
    } catch (int code) {
        thrown = code;
    }
    CHECK(thrown == 10);
}

void files()
{
    tetgenio in, out;
    fill(in);
    CHECK(mesh("pnnqQ", &in, &out) == 0);
    out.save_nodes("kept");
    out.save_elements("kept");
    out.save_faces("kept");
    out.save_edges("kept");
    out.save_neighbors("kept");
    out.save_faces2smesh("kept");
    in.save_nodes("cube");
    in.save_poly("cube");
    tetgenio read, again;
    CHECK(read.load_tetmesh("kept", tetgenbehavior::MESH));
    CHECK(read.numberoftetrahedra == out.numberoftetrahedra && read.numberoftrifaces == out.numberoftrifaces);
    CHECK(std::memcmp(read.tetrahedronlist, out.tetrahedronlist,
                      sizeof(int) * 4 * static_cast<std::size_t>(out.numberoftetrahedra)) == 0);
    CHECK(std::memcmp(read.pointlist, out.pointlist, sizeof(double) * 3 * static_cast<std::size_t>(out.numberofpoints)) == 0);
    // Twice, on what is there.
    CHECK(read.load_tetmesh("kept", tetgenbehavior::MESH));
    CHECK(mesh("rqa0.02Q", &read, &again) == 0);
    CHECK(again.numberoftetrahedra > read.numberoftetrahedra);
    read.deinitialize();
    CHECK(read.load_plc("cube", tetgenbehavior::POLY));
    CHECK(read.numberoffacets == 6 && read.facetmarkerlist[5] == 6 && read.numberofpoints == 9);
    again.clean_memory();
    CHECK(mesh("pQ", &read, &again) == 0);
    CHECK(again.numberofpoints == 8);
    // What cannot be read leaves the object as it is.
    CHECK(!read.load_poly("nothing") && read.numberoffacets == 6);
    // Without an output, files are written.
    CHECK(mesh("pqQ", &read, NULL) == 0);
    tetgenio written;
    CHECK(written.load_tetmesh("tetgen-tmpfile.1", tetgenbehavior::MESH) && written.numberoftetrahedra > 0);
    CHECK(mesh("pkIFEQ", &read, NULL) == 0);
    std::FILE *file = std::fopen("tetgen-tmpfile.vtk", "r");
    CHECK(file != NULL);
    std::fclose(file);
    // More points, and a background mesh.
    tetgenio more, sized;
    more.numberofpoints = 2;
    more.pointlist = new double[6]{0.5, 0.5, 0.5, 0.25, 0.25, 0.25};
    tetgenio added;
    CHECK(mesh("piQ", &read, &added, &more) == 0);
    CHECK(added.numberofpoints >= 10);
    CHECK(mesh("pQ", &read, &sized) == 0);
    sized.numberofpointmtrs = 1;
    sized.pointmtrlist = new double[static_cast<std::size_t>(sized.numberofpoints)];
    for (int i = 0; i < sized.numberofpoints; i++)
        sized.pointmtrlist[i] = 0.3;
    tetgenio fine;
    CHECK(mesh("pqmQ", &read, &fine, NULL, &sized) == 0);
    CHECK(fine.numberofpoints > 30);
}

/// Facets and polygons of arrays that a client fills only in part, and init() of both.
void records()
{
    tetgenio::facet *facets = new tetgenio::facet[3];
    tetgenio::polygon *polygons = new tetgenio::polygon[3];
    for (int i = 0; i < 3; i++) {
        CHECK(facets[i].polygonlist == NULL && facets[i].numberofpolygons == 0);
        CHECK(facets[i].holelist == NULL && facets[i].numberofholes == 0);
        CHECK(polygons[i].vertexlist == NULL && polygons[i].numberofvertices == 0);
    }
    polygons[0].numberofvertices = 5;
    facets[0].numberofholes = 5;
    tetgenio::init(&polygons[0]);
    tetgenio::init(&facets[0]);
    CHECK(polygons[0].numberofvertices == 0 && facets[0].numberofholes == 0);
    tetgenio io;
    io.facetlist = facets;
    io.numberoffacets = 3;
    delete[] polygons;
}

} // namespace

int main()
{
    records();
    nothing_is_written();
    ownership();
    files();
    return 0;
}
