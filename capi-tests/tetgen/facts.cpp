// Runs a string of switches on a model through whatever tetgen.h it is compiled against, and prints what holds of the result: what two
// libraries that keep TetGen's rules have in common. Counts of tetrahedra and of added points are no such thing.
//   facts MODEL FIRST SWITCHES [SWITCHES OF A SECOND RUN ON THE RESULT [SWITCHES OF A THIRD ...]] [--raw | --cost]
// MODEL is a name in models.hpp, or an .off file. --raw prints all arrays; --cost processor seconds, points, tetrahedra and the worst of both.
#include <tetgen.h>

#include "models.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <map>
#include <set>
#include <utility>
#include <vector>

#ifdef DELOTET_TETGEN_VERSION
#define FACE_TETS(io) ((io).face2tetlist)
#define EDGE_TETS(io) ((io).edge2tetlist)
#else
#define FACE_TETS(io) ((io).adjtetlist)
#define EDGE_TETS(io) ((io).edgeadjtetlist)
#endif

namespace {

using Corner = std::array<double, 3>;

Corner at(const tetgenio &io, int point)
{
    const double *p = io.pointlist + 3 * (point - io.firstnumber);
    return {p[0], p[1], p[2]};
}

Corner minus(const Corner &a, const Corner &b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

Corner cross(const Corner &a, const Corner &b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Corner &a, const Corner &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

double volume(const tetgenio &io, const int *c)
{
    const Corner a = at(io, c[0]);
    return dot(cross(minus(at(io, c[1]), a), minus(at(io, c[2]), a)), minus(at(io, c[3]), a)) / 6;
}

Corner normal(const tetgenio &io, const int *c)
{
    const Corner a = at(io, c[0]);
    return cross(minus(at(io, c[1]), a), minus(at(io, c[2]), a));
}

double rounded(double x) { return std::round(x * 1e6) / 1e6 + 0.0; }

/// Every array of the result, for reading.
void raw(const tetgenio &io)
{
    std::printf("first %d corners %d attributes %d %d mtrs %d\n", io.firstnumber, io.numberofcorners, io.numberofpointattributes,
                io.numberoftetrahedronattributes, io.numberofpointmtrs);
    for (int i = 0; i < io.numberofpoints; i++) {
        std::printf("p %d: %g %g %g", i + io.firstnumber, io.pointlist[3 * i], io.pointlist[3 * i + 1], io.pointlist[3 * i + 2]);
        for (int k = 0; k < io.numberofpointattributes && io.pointattributelist; k++)
            std::printf(" a%g", io.pointattributelist[i * io.numberofpointattributes + k]);
        for (int k = 0; k < io.numberofpointmtrs && io.pointmtrlist; k++)
            std::printf(" s%g", io.pointmtrlist[i * io.numberofpointmtrs + k]);
        if (io.pointmarkerlist)
            std::printf(" m%d", io.pointmarkerlist[i]);
        std::printf("\n");
    }
    for (int i = 0; i < io.numberoftetrahedra && io.tetrahedronlist; i++) {
        std::printf("t %d:", i + io.firstnumber);
        for (int k = 0; k < io.numberofcorners; k++)
            std::printf(" %d", io.tetrahedronlist[i * io.numberofcorners + k]);
        for (int k = 0; k < io.numberoftetrahedronattributes && io.tetrahedronattributelist; k++)
            std::printf(" a%g", io.tetrahedronattributelist[i * io.numberoftetrahedronattributes + k]);
        if (io.neighborlist)
            for (int k = 0; k < 4; k++)
                std::printf(" n%d", io.neighborlist[4 * i + k]);
        std::printf("\n");
    }
    for (int i = 0; i < io.numberoftrifaces && io.trifacelist; i++) {
        std::printf("f %d: %d %d %d", i + io.firstnumber, io.trifacelist[3 * i], io.trifacelist[3 * i + 1], io.trifacelist[3 * i + 2]);
        if (io.o2facelist)
            std::printf(" o%d o%d o%d", io.o2facelist[3 * i], io.o2facelist[3 * i + 1], io.o2facelist[3 * i + 2]);
        if (io.trifacemarkerlist)
            std::printf(" m%d", io.trifacemarkerlist[i]);
        if (FACE_TETS(io))
            std::printf(" t%d t%d", FACE_TETS(io)[2 * i], FACE_TETS(io)[2 * i + 1]);
        std::printf("\n");
    }
    for (int i = 0; i < io.numberofedges && io.edgelist; i++) {
        std::printf("e %d: %d %d", i + io.firstnumber, io.edgelist[2 * i], io.edgelist[2 * i + 1]);
        if (io.o2edgelist)
            std::printf(" o%d", io.o2edgelist[i]);
        if (io.edgemarkerlist)
            std::printf(" m%d", io.edgemarkerlist[i]);
        if (EDGE_TETS(io))
            std::printf(" t%d", EDGE_TETS(io)[i]);
        std::printf("\n");
    }
    for (int i = 0; i < io.numberofvpoints && io.vpointlist; i++)
        std::printf("vp %d: %g %g %g\n", i + io.firstnumber, io.vpointlist[3 * i], io.vpointlist[3 * i + 1], io.vpointlist[3 * i + 2]);
    for (int i = 0; i < io.numberofvedges && io.vedgelist; i++) {
        const tetgenio::voroedge &edge = io.vedgelist[i];
        std::printf("ve %d: %d %d", i + io.firstnumber, edge.v1, edge.v2);
        if (edge.v2 < io.firstnumber)
            std::printf(" towards %g %g %g", edge.vnormal[0], edge.vnormal[1], edge.vnormal[2]);
        std::printf("\n");
    }
    for (int i = 0; i < io.numberofvfacets && io.vfacetlist; i++) {
        const tetgenio::vorofacet &facet = io.vfacetlist[i];
        std::printf("vf %d: cells %d %d, %d edges:", i + io.firstnumber, facet.c1, facet.c2, facet.elist[0]);
        for (int k = 1; k <= facet.elist[0]; k++)
            std::printf(" %d", facet.elist[k]);
        std::printf("\n");
    }
    for (int i = 0; i < io.numberofvcells && io.vcelllist; i++) {
        std::printf("vc %d: %d facets:", i + io.firstnumber, io.vcelllist[i][0]);
        for (int k = 1; k <= io.vcelllist[i][0]; k++)
            std::printf(" %d", io.vcelllist[i][k]);
        std::printf("\n");
    }
}

void facts(const tetgenio &io, const tetgenio &in)
{
    const int first = io.firstnumber;
    if (!io.pointlist) { // N, or nothing was made.
        std::printf("first %d, no points, %d tetrahedra, %d faces\n", first, io.numberoftetrahedra, io.numberoftrifaces);
        return;
    }
    std::printf("first %d, corners %d, point attributes %d, tetrahedron attributes %d\n", first, io.numberofcorners,
                io.numberofpointattributes, io.numberoftetrahedronattributes);
    int kept = 0;
    for (int i = 0, j = 0; i < in.numberofpoints && j < io.numberofpoints; i++)
        if (std::equal(in.pointlist + 3 * i, in.pointlist + 3 * i + 3, io.pointlist + 3 * j)) {
            kept++;
            j++;
        }
    std::printf("input points in front: %d of %d\n", kept, in.numberofpoints);
    if (io.pointmarkerlist) {
        std::printf("markers of input points:");
        for (int i = 0; i < kept; i++)
            std::printf(" %d", io.pointmarkerlist[i]);
        std::map<int, bool> added;
        for (int i = kept; i < io.numberofpoints; i++)
            added[io.pointmarkerlist[i]] = true;
        std::printf("\nmarkers of added points:");
        for (const auto &marker : added)
            std::printf(" %d", marker.first);
        std::printf("\n");
    } else {
        std::printf("no point markers\n");
    }
    const int corners = io.numberofcorners, attributes = io.numberoftetrahedronattributes;
    if (io.numberofvcells > 0) {
        int rays = 0;
        for (int i = 0; i < io.numberofvedges; i++)
            rays += io.vedgelist[i].v2 == -1;
        std::printf("diagram: %d vertices, %d edges, %d of them rays, %d facets, %d cells\n", io.numberofvpoints, io.numberofvedges, rays,
                    io.numberofvfacets, io.numberofvcells);
    }
    std::map<double, double> volumes;
    std::map<std::array<int, 3>, std::vector<int>> faces;
    int turned = 0, outside = 0;
    for (int i = 0; i < io.numberoftetrahedra && io.tetrahedronlist; i++) {
        const int *c = io.tetrahedronlist + i * corners;
        for (int k = 0; k < corners; k++)
            outside += c[k] < first || c[k] >= first + io.numberofpoints;
        if (outside)
            break;
        const double v = volume(io, c);
        turned += v <= 0;
        volumes[attributes && io.tetrahedronattributelist ? io.tetrahedronattributelist[(i + 1) * attributes - 1] : 0] += v;
        const int sides[4][3] = {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}};
        for (const int *side : sides) {
            std::array<int, 3> face{c[side[0]], c[side[1]], c[side[2]]};
            std::sort(face.begin(), face.end());
            faces[face].push_back(i);
        }
    }
    std::printf("tetrahedra: %s, %d indices out of range, %d not positive\n", io.numberoftetrahedra > 0 ? "some" : "none", outside, turned);
    if (outside)
        return;
    for (const auto &entry : volumes)
        std::printf("volume of region %g: %.6f\n", entry.first, rounded(entry.second));
    if (io.neighborlist && io.tetrahedronlist) {
        int wrong = 0;
        for (int i = 0; i < io.numberoftetrahedra; i++)
            for (int k = 0; k < 4; k++) {
                const int *c = io.tetrahedronlist + i * corners;
                std::array<int, 3> face{c[(k + 1) % 4], c[(k + 2) % 4], c[(k + 3) % 4]};
                std::sort(face.begin(), face.end());
                const std::vector<int> &tets = faces[face];
                const int other = tets.size() == 1 ? -1 : (tets[0] == i ? tets[1] : tets[0]) + first;
                wrong += io.neighborlist[4 * i + k] != other;
            }
        std::printf("neighbours: %d wrong\n", wrong);
    } else {
        std::printf("no neighbours\n");
    }
    std::map<int, double> areas;
    int inward = 0, outward = 0, inside = 0, absent = 0, wrong_sides = 0;
    std::set<std::array<int, 3>> seen;
    for (int i = 0; i < io.numberoftrifaces && io.trifacelist; i++) {
        const int *c = io.trifacelist + 3 * i;
        const Corner n = normal(io, c);
        areas[io.trifacemarkerlist ? io.trifacemarkerlist[i] : 0] += std::sqrt(dot(n, n)) / 2;
        std::array<int, 3> face{c[0], c[1], c[2]};
        std::sort(face.begin(), face.end());
        seen.insert(face);
        const auto found = faces.find(face);
        if (found == faces.end()) {
            absent++;
        } else if (found->second.size() == 2) {
            inside++;
        } else {
            const int *t = io.tetrahedronlist + found->second[0] * corners;
            Corner middle{};
            for (int k = 0; k < 4; k++)
                for (std::size_t axis = 0; axis < 3; axis++)
                    middle[axis] += at(io, t[k])[axis] / 4;
            (dot(n, minus(middle, at(io, c[0]))) > 0 ? inward : outward)++;
        }
        if (found != faces.end() && FACE_TETS(io)) {
            std::set<int> sides{FACE_TETS(io)[2 * i], FACE_TETS(io)[2 * i + 1]}, expected;
            for (const int tet : found->second)
                expected.insert(tet + first);
            if (found->second.size() == 1)
                expected.insert(-1);
            wrong_sides += sides != expected;
        }
    }
    long boundary = 0, listed = 0;
    for (const auto &face : faces)
        if (face.second.size() == 1) {
            boundary++;
            listed += static_cast<long>(seen.count(face.first));
        }
    std::printf("faces: %s inward, %s outward, %s inside, %d of no tetrahedron, boundary %s\n", inward ? "some" : "none",
                outward ? "some" : "none", inside ? "some" : "none", absent, listed == boundary ? "complete" : "incomplete");
    for (const auto &entry : areas)
        std::printf("area of marker %d%s: %.6f\n", entry.first, io.trifacemarkerlist ? "" : " (none)", rounded(entry.second));
    if (FACE_TETS(io))
        std::printf("tetrahedra of faces: %d wrong\n", wrong_sides);
    std::map<int, double> lengths;
    for (int i = 0; i < io.numberofedges && io.edgelist; i++) {
        const Corner d = minus(at(io, io.edgelist[2 * i + 1]), at(io, io.edgelist[2 * i]));
        lengths[io.edgemarkerlist ? io.edgemarkerlist[i] : 0] += std::sqrt(dot(d, d));
    }
    std::printf("edges: %s\n", io.numberofedges > 0 ? "some" : "none");
    for (const auto &entry : lengths)
        std::printf("length of marker %d%s: %.6f\n", entry.first, io.edgemarkerlist ? "" : " (none)", rounded(entry.second));
}

void print_cost(const tetgenio &io, double seconds)
{
    double largest = 0, worst = 180;
    for (int i = 0; i < io.numberoftetrahedra; i++) {
        const int *c = io.tetrahedronlist + i * io.numberofcorners;
        largest = std::max(largest, volume(io, c));
        for (int a = 0; a < 4; a++)
            for (int b = a + 1; b < 4; b++) { // The dihedral angle across from edge ab: between the faces that have the other edge.
                int other[2], count = 0;
                for (int k = 0; k < 4; k++)
                    if (k != a && k != b)
                        other[count++] = k;
                const Corner e = minus(at(io, c[other[1]]), at(io, c[other[0]]));
                const Corner m = cross(e, minus(at(io, c[a]), at(io, c[other[0]]))), n = cross(e, minus(at(io, c[b]), at(io, c[other[0]])));
                const double cosine = dot(m, n) / std::sqrt(dot(m, m) * dot(n, n));
                worst = std::min(worst, std::acos(std::max(-1.0, std::min(1.0, cosine))) * 180 / 3.14159265358979323846);
            }
    }
    std::printf("%.3f s, %d points, %d tetrahedra, largest volume %.4g, smallest dihedral angle %.3f\n", seconds, io.numberofpoints,
                io.numberoftetrahedra, largest, worst);
}

/// The result of a run as the input of the next one.
void hand_over(const tetgenio &from, tetgenio &to)
{
    const auto ints = [](const int *list, int count) { return list ? models::copy(std::vector<int>(list, list + count)) : nullptr; };
    const auto reals = [](const double *list, int count) { return list ? models::copy(std::vector<double>(list, list + count)) : nullptr; };
    to.firstnumber = from.firstnumber;
    to.numberofpoints = from.numberofpoints;
    to.pointlist = reals(from.pointlist, 3 * from.numberofpoints);
    to.pointmarkerlist = ints(from.pointmarkerlist, from.numberofpoints);
    to.numberoftetrahedra = from.numberoftetrahedra;
    to.numberofcorners = from.numberofcorners;
    to.tetrahedronlist = ints(from.tetrahedronlist, from.numberofcorners * from.numberoftetrahedra);
    to.numberoftetrahedronattributes = from.numberoftetrahedronattributes;
    to.tetrahedronattributelist = reals(from.tetrahedronattributelist, from.numberoftetrahedronattributes * from.numberoftetrahedra);
    to.numberoftrifaces = from.numberoftrifaces;
    to.trifacelist = ints(from.trifacelist, 3 * from.numberoftrifaces);
    to.trifacemarkerlist = ints(from.trifacemarkerlist, from.numberoftrifaces);
    to.numberofedges = from.numberofedges;
    to.edgelist = ints(from.edgelist, 2 * from.numberofedges);
    to.edgemarkerlist = ints(from.edgemarkerlist, from.numberofedges);
}

} // namespace

int main(int argc, char **argv)
{
    const bool all = argc > 4 && std::strcmp(argv[argc - 1], "--raw") == 0;
    const bool cost = argc > 4 && std::strcmp(argv[argc - 1], "--cost") == 0;
    if (all || cost)
        argc--;
    if (argc < 4)
        return 2;
    std::vector<tetgenio *> stages{new tetgenio};
    models::fill(*stages[0], models::named(argv[1]), std::atoi(argv[2]));
    double seconds = 0;
    try {
        for (int i = 3; i < argc; i++) {
            tetgenio *in = stages.back(), *out = new tetgenio;
            stages.push_back(out);
            const std::clock_t start = std::clock();
            tetrahedralize(argv[i], in, out);
            seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
            if (i + 1 < argc) {
                stages.push_back(new tetgenio);
                hand_over(*out, *stages.back());
            }
        }
    } catch (int code) {
        std::printf("thrown %d\n", code);
        for (tetgenio *io : stages)
            delete io;
        return 0;
    }
    if (cost)
        print_cost(*stages.back(), seconds);
    else if (all)
        raw(*stages.back());
    else
        facts(*stages.back(), *stages[stages.size() - 2]);
    for (tetgenio *io : stages)
        delete io;
    return 0;
}
