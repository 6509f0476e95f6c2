// A run through the header, in the layout that DELOTET_TETGEN_VERSION says: what is refined is as fine as asked for, callbacks, points to be
// inserted, background meshes, second order, errors, and inputs that nothing writes to.
#include <tetgen.h>

#include "models.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#define CHECK(...)                                                                         \
    do {                                                                                   \
        if (!(__VA_ARGS__)) {                                                              \
            std::fprintf(stderr, "%s:%d: failed: %s\n", __FILE__, __LINE__, #__VA_ARGS__); \
            std::exit(1);                                                                  \
        }                                                                                  \
    } while (0)

namespace {

using P = std::array<double, 3>;

P at(const tetgenio &io, int point)
{
    const double *p = io.pointlist + 3 * (point - io.firstnumber);
    return {p[0], p[1], p[2]};
}

double volume(const P &a, const P &b, const P &c, const P &d)
{
    double e[3][3];
    for (std::size_t k = 0; k < 3; k++) {
        e[0][k] = b[k] - a[k];
        e[1][k] = c[k] - a[k];
        e[2][k] = d[k] - a[k];
    }
    return (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
            e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) / 6;
}

const int *corners(const tetgenio &io, int tet) { return io.tetrahedronlist + tet * io.numberofcorners; }

double volume(const tetgenio &io, int tet)
{
    const int *c = corners(io, tet);
    return volume(at(io, c[0]), at(io, c[1]), at(io, c[2]), at(io, c[3]));
}

P middle(const tetgenio &io, int tet)
{
    P sum{};
    for (int k = 0; k < 4; k++)
        for (std::size_t axis = 0; axis < 3; axis++)
            sum[axis] += at(io, corners(io, tet)[k])[axis] / 4;
    return sum;
}

double total(const tetgenio &io)
{
    double sum = 0;
    for (int i = 0; i < io.numberoftetrahedra; i++) {
        CHECK(volume(io, i) > 0);
        sum += volume(io, i);
    }
    return sum;
}

bool near(double a, double b) { return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b)); }

double distance(const P &a, const P &b)
{
    return std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

void run(const char *switches, tetgenio &in, tetgenio &out, tetgenio *addin = nullptr, tetgenio *bgmin = nullptr)
{
    CHECK(tetrahedralize(const_cast<char *>(switches), &in, &out, addin, bgmin) == 0);
}

int code(const char *switches, tetgenio &in)
{
    tetgenio out;
    try {
        run(switches, in, out);
    } catch (int thrown) {
        return thrown;
    }
    return 0;
}

/// Every array of an object as bytes.
std::string bytes(const tetgenio &io)
{
    std::string all(reinterpret_cast<const char *>(&io), sizeof io);
    const auto add = [&](const auto *list, int count) {
        if (list && count > 0)
            all.append(reinterpret_cast<const char *>(list), sizeof *list * static_cast<std::size_t>(count));
    };
    add(io.pointlist, 3 * io.numberofpoints);
    add(io.pointattributelist, io.numberofpointattributes * io.numberofpoints);
    add(io.pointmtrlist, io.numberofpointmtrs * io.numberofpoints);
    add(io.pointmarkerlist, io.numberofpoints);
    add(io.tetrahedronlist, io.numberofcorners * io.numberoftetrahedra);
    add(io.tetrahedronattributelist, io.numberoftetrahedronattributes * io.numberoftetrahedra);
    add(io.tetrahedronvolumelist, io.numberoftetrahedra);
    add(io.facetlist, io.numberoffacets);
    for (int i = 0; i < io.numberoffacets; i++) {
        add(io.facetlist[i].polygonlist, io.facetlist[i].numberofpolygons);
        add(io.facetlist[i].holelist, 3 * io.facetlist[i].numberofholes);
        for (int k = 0; k < io.facetlist[i].numberofpolygons; k++)
            add(io.facetlist[i].polygonlist[k].vertexlist, io.facetlist[i].polygonlist[k].numberofvertices);
    }
    add(io.facetmarkerlist, io.numberoffacets);
    add(io.holelist, 3 * io.numberofholes);
    add(io.regionlist, 5 * io.numberofregions);
    add(io.facetconstraintlist, 2 * io.numberoffacetconstraints);
    add(io.segmentconstraintlist, 3 * io.numberofsegmentconstraints);
    add(io.trifacelist, 3 * io.numberoftrifaces);
    add(io.trifacemarkerlist, io.numberoftrifaces);
    add(io.edgelist, 2 * io.numberofedges);
    add(io.edgemarkerlist, io.numberofedges);
    return all;
}

void inputs_are_never_written()
{
    const char *names[] = {"box", "marked", "regions", "window", "pieces", "sized", "bounded", "equal", "hollow", "crossing", "degenerate", "six"};
    const char *strings[] = {"pQ", "pqaAmQ", "pYYqQ", "pcdQ", "pBNEFQ", "zfennQ", "pqJo2nnfeQ"};
    for (const char *name : names)
        for (const char *switches : strings) {
            tetgenio in, out;
            models::fill(in, models::named(name), 1);
            const std::string before = bytes(in);
            std::string given = switches;
            try {
                tetrahedralize(&given[0], &in, &out);
            } catch (int) {
            }
            CHECK(bytes(in) == before && given == switches);
            if (out.numberoftetrahedra == 0 || !out.tetrahedronlist || out.numberofcorners != 4 || !out.pointlist)
                continue;
            const std::string mesh = bytes(out);
            tetgenio refined;
            run("rqaQ", out, refined);
            CHECK(bytes(out) == mesh);
        }
}

void bounds_on_volumes_hold_in_given_tetrahedra()
{
    tetgenio in, coarse, fine;
    models::fill(in, models::named("box"), 1);
    run("pqa0.2Q", in, coarse);
    coarse.tetrahedronvolumelist = new double[static_cast<std::size_t>(coarse.numberoftetrahedra)];
    for (int i = 0; i < coarse.numberoftetrahedra; i++)
        coarse.tetrahedronvolumelist[i] = middle(coarse, i)[0] < 0.7 ? 0.002 : -1;
    run("rqaQ", coarse, fine);
    CHECK(near(total(fine), 8));
    double largest = 0, far = 0;
    for (int i = 0; i < fine.numberoftetrahedra; i++) {
        if (middle(fine, i)[0] < 0.4)
            largest = std::max(largest, volume(fine, i));
        else if (middle(fine, i)[0] > 1.6)
            far = std::max(far, volume(fine, i));
    }
    CHECK(largest <= 0.002 * (1 + 1e-9));
    CHECK(far > 0.004); // What has no bound stays coarser.
    for (int i = 0; i < 3 * coarse.numberofpoints; i++)
        CHECK(fine.pointlist[i] == coarse.pointlist[i]);
}

#if DELOTET_TETGEN_VERSION >= 160
void listed_tetrahedra_are_refined()
{
    tetgenio in, coarse, fine;
    models::fill(in, models::named("box"), 0);
    run("pqa0.2Q", in, coarse);
    int first = 0;
    for (int i = 0; i < coarse.numberoftetrahedra; i++)
        if (distance(middle(coarse, i), {1, 1, 1}) < distance(middle(coarse, first), {1, 1, 1}))
            first = i;
    coarse.numberofrefineelems = 1;
    coarse.refine_elem_list = new int[4];
    std::copy(corners(coarse, first), corners(coarse, first) + 4, coarse.refine_elem_list);
    std::swap(coarse.refine_elem_list[0], coarse.refine_elem_list[3]); // The order of corners is of no importance.
    coarse.refine_elem_vol_list = new double[1]{volume(coarse, first) / 20};
    run("raQ", coarse, fine);
    CHECK(fine.numberoftetrahedra > coarse.numberoftetrahedra && near(total(fine), 8));
}
#endif

int calls;
bool long_edge(double *a, double *b, double *c, double *d, double *edges, double v)
{
    calls++;
    const double *corners[4] = {a, b, c, d};
    double longest = 0;
    for (int i = 0; i < 4; i++)
        for (int k = i + 1; k < 4; k++)
            longest = std::max(longest, distance({corners[i][0], corners[i][1], corners[i][2]}, {corners[k][0], corners[k][1], corners[k][2]}));
    CHECK(near(longest, *std::max_element(edges, edges + 6)) && v > 0);
    return longest > 0.6;
}
bool thrower(double *, double *, double *, double *, double *, double) { throw std::runtime_error("enough"); }

void callbacks_split_and_may_throw()
{
    tetgenio in, out;
    models::fill(in, models::named("box"), 0);
    in.tetunsuitable = long_edge;
    run("pqQ", in, out);
    CHECK(calls > 0 && near(total(out), 8));
    for (int i = 0; i < out.numberoftetrahedra; i++)
        for (int a = 0; a < 4; a++)
            for (int b = a + 1; b < 4; b++)
                CHECK(distance(at(out, corners(out, i)[a]), at(out, corners(out, i)[b])) <= 0.6);
    in.tetunsuitable = thrower;
    bool caught = false;
    try {
        tetgenio none;
        run("pqQ", in, none);
    } catch (const std::runtime_error &e) {
        caught = std::strcmp(e.what(), "enough") == 0;
    } catch (int thrown) { // The library may be another one than the program's: what passes is at least an int.
        caught = thrown == 2;
    }
    CHECK(caught);
}

void points_are_inserted()
{
    tetgenio in, added, out;
    models::fill(in, models::named("marked"), 1);
    models::Parts more;
    more.xyz = {1, 1, 1, 9, 9, 9, 0.5, 0.25, 1.5};
    more.point_markers = {31, 32, 33};
    models::fill(added, more, 1);
    run("piQ", in, out, &added);
    CHECK(out.numberofpoints == 10); // The one outside is of no tetrahedron.
    CHECK(out.pointmarkerlist[8] == 31 && out.pointmarkerlist[9] == 33 && out.pointlist[3 * 9 + 1] == 0.25 && near(total(out), 8));
    tetgenio refined;
    run("riQ", out, refined, &added);
    CHECK(refined.numberofpoints == 10 && near(total(refined), 8));
    tetgenio cloud, plain;
    models::Parts points = models::named("six");
    models::fill(cloud, points, 0);
    run("iQ", cloud, plain, &added);
    CHECK(plain.numberofpoints == 7); // One equals a given one, one is outside of the hull, one is new.
    tetgenio ignored;
    run("pQ", in, ignored, &added);
    CHECK(ignored.numberofpoints == 8);
}

void sizes_are_kept()
{
    tetgenio in, ground, out, plain;
    models::fill(in, models::named("box"), 1);
    models::Parts parts = models::named("box");
    parts.facets.clear();
    parts.facet_markers.clear();
    tetgenio corner;
    models::fill(corner, parts, 1);
    run("Q", corner, ground);
    ground.numberofpointmtrs = 1;
    ground.pointmtrlist = new double[8];
    for (int i = 0; i < 8; i++) // From 0.1 at x = 0 to 0.5 at x = 2.
        ground.pointmtrlist[i] = ground.pointlist[3 * i] == 0 ? 0.1 : 0.5;
    run("pqmQ", in, out, nullptr, &ground);
    run("pqQ", in, plain);
    CHECK(near(total(out), 8) && out.numberofpoints > 4 * plain.numberofpoints);
    int low = 0, high = 0;
    for (int i = 0; i < out.numberofpoints; i++)
        (out.pointlist[3 * i] < 1 ? low : high)++;
    CHECK(low > 2 * high);

    tetgenio sized, fine;
    models::fill(sized, models::named("sized"), 0);
    run("pqmQ", sized, fine);
    CHECK(fine.numberofpointmtrs == 1 && fine.pointmtrlist[0] == 0.3 && fine.pointmtrlist[1] == 1);
    for (int i = 8; i < fine.numberofpoints; i++)
        CHECK(fine.pointmtrlist[i] >= 0.3 && fine.pointmtrlist[i] <= 1);
}

void bounds_of_facets_and_segments_hold()
{
    tetgenio in, out;
    models::fill(in, models::named("bounded"), 1);
    run("pqQ", in, out);
    for (int i = 0; i < out.numberoftrifaces; i++)
        if (out.trifacemarkerlist[i] == 11) {
            const P a = at(out, out.trifacelist[3 * i]), b = at(out, out.trifacelist[3 * i + 1]), c = at(out, out.trifacelist[3 * i + 2]);
            CHECK(std::abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2 <= 0.05);
        }
    for (int i = 0; i < out.numberofedges; i++) { // The segment from (0, 2, 2) to (2, 2, 2).
        const P a = at(out, out.edgelist[2 * i]), b = at(out, out.edgelist[2 * i + 1]);
        if (a[1] == 2 && a[2] == 2 && b[1] == 2 && b[2] == 2)
            CHECK(distance(a, b) <= 0.2);
    }
}

void limits_on_points_hold()
{
    for (int limit : {0, 5, 40, 200}) {
        tetgenio in, out;
        models::fill(in, models::named("box"), 1);
        run(("pqa0.01QS" + std::to_string(limit)).c_str(), in, out);
        CHECK(out.numberofpoints <= 8 + limit && near(total(out), 8));
    }
}

void nodes_of_second_order_are_midpoints()
{
    for (const char *switches : {"pqo2Q", "pqo2z1Q", "po2feQ", "o2Q"}) {
        tetgenio in, out;
        models::fill(in, models::named("box"), 1);
        run(switches, in, out);
        const int pairs[6][2] = {{2, 3}, {0, 3}, {0, 1}, {1, 2}, {1, 3}, {0, 2}};
        CHECK(out.numberofcorners == 10);
        const auto halfway = [&](int node, int a, int b) {
            for (std::size_t axis = 0; axis < 3; axis++)
                CHECK(at(out, node)[axis] == (at(out, a)[axis] + at(out, b)[axis]) / 2);
        };
        for (int i = 0; i < out.numberoftetrahedra; i++) {
            const int *c = corners(out, i);
            // z1 turns tetrahedra around in TetGen 1.6 only.
            CHECK(DELOTET_TETGEN_VERSION >= 160 && std::strstr(switches, "z1") ? volume(out, i) < 0 : volume(out, i) > 0);
            for (int k = 0; k < 6; k++)
                halfway(c[4 + k], c[pairs[k][0]], c[pairs[k][1]]);
        }
        for (int i = 0; i < out.numberofedges; i++)
            halfway(out.o2edgelist[i], out.edgelist[2 * i], out.edgelist[2 * i + 1]);
    }
}

void several_attributes_survive_refining()
{
    tetgenio in, coarse, fine;
    models::fill(in, models::named("regions"), 0);
    run("pqAQ", in, coarse);
    tetgenio given;
    given.numberofpoints = coarse.numberofpoints;
    given.pointlist = models::copy(std::vector<double>(coarse.pointlist, coarse.pointlist + 3 * coarse.numberofpoints));
    given.numberoftetrahedra = coarse.numberoftetrahedra;
    given.tetrahedronlist = models::copy(std::vector<int>(coarse.tetrahedronlist, coarse.tetrahedronlist + 4 * coarse.numberoftetrahedra));
    given.numberoftetrahedronattributes = 2;
    given.tetrahedronattributelist = new double[static_cast<std::size_t>(2 * given.numberoftetrahedra)];
    for (int i = 0; i < given.numberoftetrahedra; i++) {
        given.tetrahedronattributelist[2 * i] = coarse.tetrahedronattributelist[i] == 11 ? 0.5 : 7;
        given.tetrahedronattributelist[2 * i + 1] = coarse.tetrahedronattributelist[i];
    }
    for (const char *switches : {"rQ", "rqa0.05Q", "rYqa0.05Q"}) {
        tetgenio out;
        run(switches, given, out);
        CHECK(out.numberoftetrahedronattributes == 2);
        double inner = 0, outer = 0;
        for (int i = 0; i < out.numberoftetrahedra; i++) {
            const double *row = out.tetrahedronattributelist + 2 * i;
            CHECK((row[0] == 0.5 && row[1] == 11) || (row[0] == 7 && row[1] == 22));
            (row[1] == 11 ? inner : outer) += volume(out, i);
        }
        CHECK(near(inner, 8) && near(outer, 56));
    }
}

void hollow_meshes_stay_hollow()
{
    tetgenio in, coarse, fine;
    models::fill(in, models::named("hollow"), 1);
    run("pqQ", in, coarse);
    run("rqa0.3Q", coarse, fine);
    CHECK(near(total(fine), 56));
}

void errors_are_ints()
{
    const struct {
        const char *model, *switches;
        int code;
    } cases[] = {{"crossing", "pQ", 3},  {"crossing", "pYYqQ", 3}, {"bad_index", "pQ", 10}, {"flat", "Q", 10},  {"planar_flat", "pQ", 10},
                 {"none", "Q", 10},      {"none", "pQ", 10},       {"points", "rQ", 10},    {"box", "pRQ", 10}, {"open", "pQ", 0},
                 {"stray_seed", "pAQ", 0}, {"twice", "pQ", 0},     {"degenerate", "pQ", 0}};
    for (const auto &one : cases) {
        tetgenio in;
        models::fill(in, models::named(one.model), 0);
        CHECK(code(one.switches, in) == one.code);
    }
    tetgenio in;
    models::fill(in, models::named("box"), 0);
    in.pointlist[4] = std::nan("");
    CHECK(code("pQ", in) == 10);
    in.pointlist[4] = 0;
    in.firstnumber = 1; // Now a corner is below the first.
    CHECK(code("pQ", in) == 10);
}

/// A square with a square hole, walked along in one polygon, in a box.
void polygons_may_meet_a_corner_twice()
{
    for (bool seed : {false, true}) {
        models::Parts parts;
        parts.box(0, 4, 1);
        const int at = parts.points();
        for (double low : {1.0, 1.5})
            parts.xyz.insert(parts.xyz.end(), {low, low, 2, 4 - low, low, 2, 4 - low, 4 - low, 2, low, 4 - low, 2});
        parts.facets.push_back({{at, at + 1, at + 2, at + 3, at, at + 4, at + 5, at + 6, at + 7, at + 4}});
        parts.facet_markers.push_back(9);
        parts.facet_holes.resize(parts.facets.size());
        if (seed)
            parts.facet_holes.back() = {2, 2, 2};
        tetgenio in, out;
        models::fill(in, parts, 0);
        run("pQ", in, out);
        double area = 0;
        for (int i = 0; i < out.numberoftrifaces; i++)
            if (out.trifacemarkerlist[i] == 9) {
                const P a = ::at(out, out.trifacelist[3 * i]), b = ::at(out, out.trifacelist[3 * i + 1]), c = ::at(out, out.trifacelist[3 * i + 2]);
                area += std::abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
            }
        CHECK(near(area, seed ? 3 : 4));
    }
}

/// Programs set only the members that they need of facets and polygons; markers and lists may be NULL.
void members_without_a_use_are_not_read()
{
    tetgenio in, out;
    models::fill(in, models::named("unmarked"), 1);
    for (int i = 0; i < in.numberoffacets; i++) { // What memory of an earlier use may contain.
        in.facetlist[i].numberofholes = 1234567;
        std::memset(static_cast<void *>(&in.facetlist[i].holelist), 0x5a, sizeof in.facetlist[i].holelist);
    }
    in.numberofholes = in.numberofregions = in.numberofedges = in.numberofpointmtrs = in.numberofpointattributes = 77;
    in.numberoffacetconstraints = in.numberofsegmentconstraints = in.numberoftrifaces = 77; // Counts without a list.
    run("pqaAmQ", in, out);
    CHECK(near(total(out), 8));
    for (int i = 0; i < in.numberoffacets; i++) {
        in.facetlist[i].numberofholes = 0;
        in.facetlist[i].holelist = nullptr;
    }
}

void diagrams_are_dual()
{
    for (const char *switches : {"vQ", "wvQ", "zvQ"}) {
        tetgenio in, out;
        models::fill(in, models::named("six"), 1);
        in.numberofpointattributes = 1;
        in.pointattributelist = new double[6]{0.5, 0, 0.25, 0, 1, 0.75};
        run(switches, in, out);
        CHECK(out.numberofvpoints == out.numberoftetrahedra && out.numberofvcells == 6);
        const bool weighted = switches[0] == 'w';
        const auto power = [&](const double *x, int point) {
            const P p = at(out, point);
            const double d = distance({x[0], x[1], x[2]}, p);
            return d * d - (weighted ? out.pointattributelist[point - out.firstnumber] : 0);
        };
        for (int i = 0; i < out.numberofvpoints; i++)
            for (int k = 1; k < 4; k++)
                CHECK(std::abs(power(out.vpointlist + 3 * i, corners(out, i)[k]) - power(out.vpointlist + 3 * i, corners(out, i)[0])) < 1e-9);
        for (int i = 0; i < out.numberofvfacets; i++) {
            const tetgenio::vorofacet &facet = out.vfacetlist[i];
            for (int k = 1; k <= facet.elist[0]; k++) {
                CHECK(facet.elist[k] >= out.firstnumber || k == facet.elist[0]);
                if (facet.elist[k] < out.firstnumber)
                    continue;
                const tetgenio::voroedge &edge = out.vedgelist[facet.elist[k] - out.firstnumber];
                const double *from = out.vpointlist + 3 * (edge.v1 - out.firstnumber);
                CHECK(std::abs(power(from, facet.c1) - power(from, facet.c2)) < 1e-9);
                if (edge.v2 != -1)
                    continue;
                // Far out on a ray no point is nearer than those of its facets.
                const double far[3] = {from[0] + 100 * edge.vnormal[0], from[1] + 100 * edge.vnormal[1], from[2] + 100 * edge.vnormal[2]};
                for (int point = 0; point < 6; point++)
                    CHECK(power(far, point + out.firstnumber) >= power(far, facet.c1) - 1e-9);
            }
        }
    }
    tetgenio in, out;
    models::fill(in, models::named("weighted"), 0);
    run("wvQ", in, out);
    CHECK(out.numberofpoints == 6 && out.vcelllist[5][0] == 0); // A hidden point stays, without a cell.
}

} // namespace

int main()
{
    inputs_are_never_written();
    bounds_on_volumes_hold_in_given_tetrahedra();
#if DELOTET_TETGEN_VERSION >= 160
    listed_tetrahedra_are_refined();
#endif
    callbacks_split_and_may_throw();
    points_are_inserted();
    sizes_are_kept();
    bounds_of_facets_and_segments_hold();
    limits_on_points_hold();
    nodes_of_second_order_are_midpoints();
    several_attributes_survive_refining();
    hollow_meshes_stay_hollow();
    errors_are_ints();
    polygons_may_meet_a_corner_twice();
    members_without_a_use_are_not_read();
    diagrams_are_dual();
    std::puts("all passed");
    return 0;
}
