// The readers on files of every kind, and on files that lie about their lengths, end early or are garbage: they return false, and use
// memory only for what is there.
#include <tetgen.h>

#include "check.hpp"

#include <sys/resource.h>

#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

void write(const std::string &path, const std::string &content)
{
    std::FILE *file = std::fopen(path.c_str(), "wb");
    CHECK(file != NULL);
    CHECK(std::fwrite(content.data(), 1, content.size(), file) == content.size());
    CHECK(std::fclose(file) == 0);
}

const char *const nodes = "# a comment\n\n5 3 1 1\n# another\n1 0 0 0  5 7\n2 1,0,0, 6 8\n3\t0 1 0 5 9 # at the end\n4 0 0 1e0 +5 -1\n5 .25 .25 .25 1 2\n";
const char *const poly =
    "4 3\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n# facets\n4 1\n2 1 5\n3 0 1 2\n2 0 1\n1 .1 .2 .3\n1 0 -3\n3 0 1\n3\n1 # one\n3 0 2 3\n"
    "1 0 9\n3 1 2 3\n1\n1 .1 .1 .1\n2\n1 .2 .2 .2 7\n2 .2 .2 .2 7 0.5\n";
const char *const smesh = "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n4 1\n3 1 2 3 5\n3 1 2 4 6\n3 1 3 4\n3 2 3 4 7\n0\n1\n1 .1 .1 .1 3 -1\n";
const char *const off = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 1 3\n3 0 2 3\n3 1 2 3\n";
const char *const ply = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 2\n"
                        "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 1 3\n";
const char *const stl = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
                        "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\nendfacet\nendsolid\n";
const char *const medit = "MeshVersionFormatted 1\nDimension 3\nVertices\n4\n0 0 0 1\n1 0 0 2\n0 1 0 3\n0 0 1 4\nTriangles\n2\n1 2 3 5\n"
                          "1 2 4 6\nQuadrilaterals 1\n1 2 3 4 8\nTetrahedra\n1\n1 2 3 4 9\nCorners 2 1 2\nEdges\n1\n1 2 3\nEnd\n";
const char *const vtk = "# vtk DataFile Version 2.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
                        "POLYGONS 2 8\n3 0 1 2\n3 0 1 3\n";

void what_is_right_is_read()
{
    write("a.node", nodes);
    tetgenio io;
    CHECK(io.load_node("a"));
    CHECK(io.firstnumber == 1 && io.numberofpoints == 5 && io.numberofpointattributes == 1);
    CHECK(io.pointlist[5 * 3 - 1] == 0.25 && io.pointattributelist[3] == 5 && io.pointmarkerlist[3] == -1);
    write("a.ele", "1 4 1\n1 1 2 3 4 5\n");
    write("a.face", "2 1\n1 1 2 3 4\n2 1 2 4 5\n");
    write("a.edge", "1 1\n1 1 2 3\n");
    write("a.vol", "1\n1 0.5\n");
    write("a.mtr", "5 1\n0.1\n0.2\n0.3\n0.4\n.5\n");
    write("a.var", "1\n1 3 0.5\n1\n1 1 2 0.3\n");
    CHECK(io.load_tetmesh("a", tetgenbehavior::MESH));
    CHECK(io.numberoftetrahedra == 1 && io.tetrahedronattributelist[0] == 5 && io.tetrahedronvolumelist[0] == 0.5);
    CHECK(io.numberoftrifaces == 2 && io.trifacemarkerlist[1] == 5 && io.numberofedges == 1 && io.edgemarkerlist[0] == 3);
    CHECK(io.numberofpointmtrs == 1 && io.pointmtrlist[4] == 0.5);
    CHECK(io.numberoffacetconstraints == 1 && io.facetconstraintlist[1] == 0.5 && io.segmentconstraintlist[2] == 0.3);

    write("b.poly", poly);
    tetgenio p;
    CHECK(p.load_plc("b", tetgenbehavior::POLY));
    CHECK(p.firstnumber == 0 && p.numberoffacets == 4 && p.facetlist[0].numberofpolygons == 2 && p.facetlist[0].numberofholes == 1);
    CHECK(p.facetmarkerlist[1] == -3 && p.facetmarkerlist[2] == 0 && p.facetlist[1].polygonlist[0].vertexlist[2] == 3);
    CHECK(p.numberofholes == 1 && p.numberofregions == 2 && p.regionlist[4] == 7 && p.regionlist[9] == 0.5);
    write("c.smesh", smesh);
    tetgenio s;
    CHECK(s.load_poly("c") && s.numberoffacets == 4 && s.facetmarkerlist[2] == 0 && s.facetmarkerlist[3] == 7 && s.regionlist[3] == 3);
    write("d.poly", "0 3 0 0\n1 0\n1\n3 1 2 3\n0\n");
    write("d.node", nodes);
    tetgenio d;
    CHECK(d.load_poly("d") && d.numberofpoints == 5 && d.facetmarkerlist == NULL && d.numberofholes == 0);

    write("e.off", off);
    write("e.ply", ply);
    write("e.stl", stl);
    write("e.mesh", medit);
    write("e.vtk", vtk);
    tetgenio e;
    CHECK(e.load_off("e") && e.numberofpoints == 4 && e.numberoffacets == 4 && e.firstnumber == 0);
    CHECK(e.load_ply("e") && e.numberoffacets == 2 && e.facetlist[1].polygonlist[0].vertexlist[2] == 3);
    CHECK(e.load_stl("e") && e.numberoffacets == 2 && e.numberofpoints == 4 && e.firstnumber == 1);
    CHECK(e.load_vtk("e") && e.numberoffacets == 2 && e.firstnumber == 0);
    CHECK(e.load_medit("e", 0) && e.numberoffacets == 3 && e.facetmarkerlist[2] == 8 && e.numberoftetrahedra == 1);
    CHECK(e.load_medit("e", 1) && e.numberoftrifaces == 2 && e.trifacemarkerlist[1] == 6 && e.edgemarkerlist[0] == 3);
}

/// Reads a file under all names, as every kind; the result does not matter, but nothing may crash, hang or fill the memory.
int read_all(const std::string &content)
{
    int good = 0;
    static const char *const extensions[] = {".node", ".poly", ".smesh", ".off",  ".ply", ".stl", ".mesh",
                                             ".vtk",  ".ele",  ".face",  ".edge", ".vol", ".mtr", ".var"};
    for (const char *extension : extensions)
        write(std::string("x") + extension, content);
    tetgenio io;
    good += io.load_poly("x");
    good += io.load_node("x");
    good += io.load_off("x");
    good += io.load_ply("x");
    good += io.load_stl("x");
    good += io.load_vtk("x");
    good += io.load_medit("x", 0);
    good += io.load_medit("x", 1);
    good += io.load_tet("x");
    good += io.load_face("x");
    good += io.load_edge("x");
    good += io.load_vol("x");
    good += io.load_mtr("x");
    good += io.load_var("x");
    for (const char *extension : extensions)
        std::remove((std::string("x") + extension).c_str());
    return good;
}

void what_is_wrong_is_refused()
{
    static const char *const wrong[] = {"",
                                        "\n\n# nothing\n",
                                        "-4 3 0 0\n1 0 0 0\n",
                                        "2147483647 3 0 0\n1 0 0 0\n",
                                        "99999999999999999999 3 0 0\n1 0 0 0\n",
                                        "1e300 3 0 0\n1 0 0 0\n",
                                        "nan 3 0 0\n1 0 0 0\n",
                                        "1 3 2147483647 0\n1 0 0 0\n",
                                        "1 3 -1 0\n1 0 0 0\n",
                                        "1 99 0 0\n1 0 0 0\n",
                                        "1 3 0 0\n1 0 nan 0\n",
                                        "1 3 0 0\n1 0 1e999 0\n",
                                        "1 3 0 0\n1 0 0x10 0\n",
                                        "1 3 0 0\n1 0 0\n",
                                        "OFF\n2147483647 2147483647 0\n0 0 0\n",
                                        "ply\nformat ascii 1.0\nelement vertex 2147483647\nproperty float x\nend_header\n1\n",
                                        "MeshVersionFormatted 1\nDimension 3\nVertices 2147483647\n1 0 0 0\n",
                                        "# vtk\nPOINTS 2147483647 float\n1 2 3\nPOLYGONS 5 5\n",
                                        "# vtk\nBINARY\nPOINTS 4 float\n"};
    for (const char *content : wrong) {
        read_all(content);
        for (const char *extension : {".node", ".poly", ".off", ".ply", ".stl", ".vtk", ".mesh"})
            write(std::string("w") + extension, content);
        tetgenio refused;
        CHECK(!refused.load_node("w") && !refused.load_poly("w") && !refused.load_off("w") && !refused.load_ply("w"));
        CHECK(!refused.load_stl("w") && !refused.load_vtk("w") && !refused.load_medit("w", 0) && !refused.load_medit("w", 1));
        CHECK(refused.pointlist == NULL && refused.numberofpoints == 0);
    }
    // Counts of a facet, a polygon and the lists behind.
    const std::string start = "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";
    tetgenio io;
    for (const char *rest : {"2147483647 1\n1 0 1\n3 1 2 3\n", "1 1\n2147483647\n3 1 2 3\n", "1 1\n1\n2147483647 1 2 3\n", "1\n1\n-3 1 2 3\n",
                             "1\n1 2147483647\n3 1 2 3\n", "0\n2147483647\n1 0 0 0\n", "0\n0\n2147483647\n1 0 0 0 1 1\n", "1\n1\n3 1 2 x\n", "1\n"}) {
        write("y.poly", start + rest);
        CHECK(!io.load_poly("y"));
        CHECK(io.pointlist == NULL && io.facetlist == NULL);
    }
    write("z.node", start);
    CHECK(io.load_node("z"));
    write("z.ele", "2147483647 4 0\n1 1 2 3 4\n");
    CHECK(!io.load_tet("z"));
    write("z.ele", "1 5 0\n1 1 2 3 4 5\n");
    CHECK(!io.load_tet("z"));
    write("z.mtr", "5 1\n1\n1\n1\n1\n1\n");
    CHECK(!io.load_mtr("z"));
    write("z.vol", "3\n1 1\n2 1\n3 1\n");
    CHECK(!io.load_vol("z"));
    // A line without end, of twenty million characters.
    write("long.node", std::string(20000000, '1'));
    CHECK(!io.load_node("long"));
    write("long.node", "4 3 0 0\n" + std::string(20000000, ' '));
    CHECK(!io.load_node("long"));
    std::remove("long.node");
    CHECK(io.numberofpoints == 4);
    // A folder, and a file without end.
    CHECK(!io.load_node("."));
    write("l.node", "");
    CHECK(!io.load_node("l"));
}

/// Every right file with parts cut out, doubled, and bytes changed: the same changes in every run.
void damaged_files()
{
    std::uint64_t state = 7;
    const auto random = [&state](std::size_t below) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return static_cast<std::size_t>(state >> 33) % below;
    };
    int read = 0;
    for (const char *right : {nodes, poly, smesh, off, ply, stl, medit, vtk}) {
        for (int i = 0; i < 60; i++) {
            std::string text = right;
            for (std::size_t changes = random(3) + 1; changes > 0; changes--) {
                const std::size_t at = random(text.size());
                switch (random(4)) {
                case 0: text.resize(at + 1); break;
                case 1: text[at] = static_cast<char>(random(256)); break;
                case 2: text.insert(at, text.substr(random(text.size()), 20)); break;
                default: text[at] = "0123456789-. \n"[random(14)]; break;
                }
            }
            read += read_all(text);
        }
    }
    std::printf("%d readers took a damaged file for a whole one\n", read);
}

} // namespace

int main()
{
#ifndef __SANITIZE_ADDRESS__
    // Claims of a file must not become memory.
    const rlimit limit = {std::size_t(1) << 30, std::size_t(1) << 30};
    CHECK(setrlimit(RLIMIT_AS, &limit) == 0);
#endif
    CHECK(std::freopen("said.txt", "w", stderr) != NULL);
    what_is_right_is_read();
    what_is_wrong_is_refused();
    damaged_files();
    return 0;
}
