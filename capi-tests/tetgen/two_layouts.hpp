// One source for both layouts: a program can have both.
#include "check.hpp"

#include <cstring>

namespace {

/// Meshes a cube, with its corners numbered from 1; the number of tetrahedra.
int cube()
{
    tetgenio in, out;
    in.firstnumber = 1;
    in.numberofpoints = 8;
    in.pointlist = new double[24];
    for (int i = 0; i < 8; i++)
        for (int axis = 0; axis < 3; axis++)
            in.pointlist[3 * i + axis] = (i >> axis) & 1;
    static const int sides[6][4] = {{1, 2, 4, 3}, {5, 6, 8, 7}, {1, 2, 6, 5}, {3, 4, 8, 7}, {1, 3, 7, 5}, {2, 4, 8, 6}};
    in.numberoffacets = 6;
    in.facetlist = new tetgenio::facet[6];
    for (int i = 0; i < 6; i++) {
        in.facetlist[i].numberofpolygons = 1;
        in.facetlist[i].polygonlist = new tetgenio::polygon[1];
        in.facetlist[i].polygonlist[0].numberofvertices = 4;
        in.facetlist[i].polygonlist[0].vertexlist = new int[4];
        std::memcpy(in.facetlist[i].polygonlist[0].vertexlist, sides[i], sizeof(sides[i]));
    }
    char switches[] = "pnnfeQ";
    CHECK(tetrahedralize(switches, &in, &out) == 0);
    CHECK(out.firstnumber == 1 && out.numberofpoints == 8 && out.numberoftetrahedra >= 5);
    // Both generations of names are the same arrays.
    CHECK(out.adjtetlist != NULL && out.adjtetlist == out.face2tetlist && out.edgeadjtetlist == out.edge2tetlist);
    tetgenbehavior b;
    CHECK(b.parse_commandline(switches));
    out.clean_memory();
    CHECK(tetrahedralize(&b, &in, &out) == 0);
    char name[] = "cube";
    in.save_nodes(name);
    in.save_poly(name);
    tetgenio read;
    CHECK(read.load_poly(name) && read.numberoffacets == 6);
    return out.numberoftetrahedra;
}

} // namespace
