// A program as others write them for TetGen; it compiles with TetGen's own header, too.
#define TETLIBRARY
#include "tetgen.h"

#include <cmath>
#include <cstdio>

int main()
{
    tetgenio in, out;
    in.firstnumber = 1;
    in.numberofpoints = 8;
    in.pointlist = new REAL[24];
    for (int i = 0; i < 24; i++)
        in.pointlist[i] = (i / 3 >> i % 3) & 1;
    static const int sides[6][4] = {{1, 2, 4, 3}, {5, 6, 8, 7}, {1, 2, 6, 5}, {3, 4, 8, 7}, {1, 3, 7, 5}, {2, 4, 8, 6}};
    in.numberoffacets = 6;
    in.facetlist = new tetgenio::facet[6];
    in.facetmarkerlist = new int[6];
    for (int i = 0; i < 6; i++) {
        tetgenio::facet *f = &in.facetlist[i];
        in.facetmarkerlist[i] = i + 1;
        f->numberofholes = 0;
        f->holelist = NULL;
        f->numberofpolygons = 1;
        f->polygonlist = new tetgenio::polygon[1];
        f->polygonlist[0].numberofvertices = 4;
        f->polygonlist[0].vertexlist = new int[4];
        for (int j = 0; j < 4; j++)
            f->polygonlist[0].vertexlist[j] = sides[i][j];
    }
    char switches[] = "pq1.4a0.05Q";
    tetrahedralize(switches, &in, &out);
    double volume = 0;
    for (int i = 0; i < out.numberoftetrahedra; i++) {
        const REAL *p[4];
        for (int j = 0; j < 4; j++)
            p[j] = out.pointlist + 3 * (out.tetrahedronlist[4 * i + j] - out.firstnumber);
        double e[3][3];
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++)
                e[j][k] = p[j + 1][k] - p[0][k];
        volume += (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                   e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) / 6;
    }
    std::printf("%d points, %d tetrahedra, volume %.15g\n", out.numberofpoints, out.numberoftetrahedra, std::fabs(volume));
    return std::fabs(std::fabs(volume) - 1) < 1e-12 && out.numberoftetrahedra > 20 ? 0 : 1;
}
