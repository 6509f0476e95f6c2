// The Voronoi diagram (v) of the points of a mesh, with weights (w) their power diagram, as TetGen lists it.
//
// A ray ends in -1 and has the direction in which it leaves the hull. (Debian's TetGen 1.5 lists the opposite one.) An unbounded facet
// begins and ends with a ray, and it and unbounded cells have a -1 at the end of their lists, which counts.
#include "stages.hpp"

#include <new>

namespace delotet_tetgen {

namespace {

/// A list with its length in front.
int *new_list(delotet::Span<const Index> members, bool bounded, int first)
{
    const std::size_t count = members.size() + (bounded ? 0 : 1);
    int *list = new int[count + 1];
    list[0] = static_cast<int>(count);
    for (std::size_t i = 0; i < members.size(); i++)
        list[i + 1] = static_cast<int>(members[i]) + first;
    if (!bounded)
        list[count] = -1;
    return list;
}

} // namespace

void write_voronoi(const delotet::Mesh &mesh, const std::vector<int> &numbers, tetgenio &out)
{
    const delotet::Voronoi diagram = mesh.voronoi();
    const int first = out.firstnumber;
    const delotet::Span<const delotet::Point> vertices = diagram.vertices();
    const delotet::Records<delotet::VoronoiEdge> edges = diagram.edges();
    const delotet::Records<delotet::VoronoiFacet> facets = diagram.facets();
    const delotet::Records<delotet::VoronoiCell> cells = diagram.cells();
    count_of(facets.size() + edges.size() + 1);

    out.vpointlist = new_array<double>(vertices.size(), 3);
    out.numberofvpoints = count_of(vertices.size());
    for (std::size_t i = 0; i < vertices.size(); i++)
        for (std::size_t axis = 0; axis < 3; axis++)
            out.vpointlist[3 * i + axis] = vertices[i][axis];
    out.vedgelist = new_array<tetgenio::voroedge>(edges.size());
    out.numberofvedges = count_of(edges.size());
    for (std::size_t i = 0; i < edges.size(); i++) {
        const delotet::VoronoiEdge &edge = edges[i];
        tetgenio::voroedge &to = out.vedgelist[i];
        to.v1 = static_cast<int>(edge.vertices[0]) + first;
        to.v2 = edge.vertices[1] == delotet::invalid_index ? -1 : static_cast<int>(edge.vertices[1]) + first;
        for (std::size_t axis = 0; axis < 3; axis++)
            to.vnormal[axis] = edge.direction[axis];
    }
    // Counts grow with the lists, so that what a failure leaves can be freed.
    out.vfacetlist = new_array<tetgenio::vorofacet>(facets.size());
    for (std::size_t i = 0; i < facets.size(); i++) {
        tetgenio::vorofacet &to = out.vfacetlist[i];
        to.c1 = numbers[facets[i].cells[0]];
        to.c2 = numbers[facets[i].cells[1]];
        to.elist = new_list(diagram.edges_of(facets[i]), facets[i].bounded, first);
        out.numberofvfacets++;
    }
    std::size_t count = 0;
    for (std::size_t i = 0; i < cells.size(); i++)
        count += numbers[i] >= first;
    out.vcelllist = new_array<int *>(count);
    for (std::size_t i = 0; i < cells.size(); i++)
        if (numbers[i] >= first) {
            // Hidden points have a cell without facets.
            out.vcelllist[out.numberofvcells] = new_list(diagram.facets_of(cells[i]), cells[i].bounded || cells[i].count == 0, first);
            out.numberofvcells++;
        }
}

} // namespace delotet_tetgen
