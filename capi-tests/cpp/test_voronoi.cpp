// Weights of points and Voronoi diagrams through the C++ wrapper.
#include "test.hpp"

#include <cmath>

constexpr int side = 4;

static std::vector<Point> grid()
{
    std::vector<Point> points;
    for (int i = 0; i < side * side * side; i++)
        points.push_back({double(i % side), double(i / side % side), double(i / side / side)});
    return points;
}

// The volume of the bounded cells of a diagram of points: a pyramid over each triangle of each facet.
static double volume(const delotet::Voronoi &diagram, const std::vector<Point> &points)
{
    double sum = 0;
    std::size_t number = 0;
    for (const delotet::VoronoiCell &cell : diagram.cells()) {
        const Point &apex = points[number++];
        if (!cell.bounded)
            continue;
        for (const Index f : diagram.facets_of(cell)) {
            const delotet::VoronoiFacet &facet = diagram.facets()[f];
            const auto ring = diagram.edges_of(facet);
            std::vector<Point> corners;
            for (std::size_t k = 0; k < ring.size(); k++) {
                const delotet::VoronoiEdge &edge = diagram.edges()[ring[k]];
                const delotet::VoronoiEdge &next = diagram.edges()[ring[(k + 1) % ring.size()]];
                const bool second = edge.vertices[1] == next.vertices[0] || edge.vertices[1] == next.vertices[1];
                Point at = diagram.vertices()[edge.vertices[second ? 1 : 0]];
                for (int i = 0; i < 3; i++)
                    at[i] -= apex[i];
                corners.push_back(at);
            }
            for (std::size_t k = 2; k < corners.size(); k++) {
                const Point &a = corners[0], &b = corners[k - 1], &c = corners[k];
                sum += std::abs(a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
                                a[2] * (b[0] * c[1] - b[1] * c[0]));
            }
        }
    }
    return sum / 6;
}

int main()
{
    const std::vector<Point> points = grid();
    delotet::Options options;
    options.mode(delotet::Mode::delaunay);
    delotet::Plc plc(points);
    const delotet::Mesh plain = delotet::tetrahedralize(plc, options);
    CHECK(plain.hidden_points().empty() && plain.point_weights().empty());
    const delotet::Voronoi diagram = plain.voronoi();
    CHECK(diagram.vertices().size() == plain.tets().size() && diagram.cells().size() == points.size());
    CHECK(diagram.edges().size() == plain.faces().size() && diagram.facets().size() == plain.edges().size());
    // Eight unit cubes.
    CHECK(volume(diagram, points) == 8);

    std::vector<double> weights(points.size(), 0);
    weights[21] = 3.5;
    plc.set_point_weights(weights);
    CHECK(plc.point_weights().size() == points.size() && plc.point_weights()[21] == 3.5);
    const delotet::Mesh weighted = delotet::tetrahedralize(plc, options);
    weighted.check(plc);
    CHECK(weighted.hidden_points().size() == 3 && weighted.point_weights()[21] == 3.5);
    const delotet::Voronoi power = weighted.voronoi();
    for (const Index hidden : weighted.hidden_points())
        CHECK(power.cells()[hidden].count == 0 && power.facets_of(power.cells()[hidden]).empty());

    std::vector<double> heights;
    for (const Point &p : points)
        heights.push_back(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    plc.set_point_heights(heights);
    const delotet::Mesh lifted = delotet::tetrahedralize(plc, options);
    CHECK(lifted.tets().size() == plain.tets().size());

    delotet::Error error;
    CHECK(plc.set_point_weights(delotet::Span<const double>(weights.data(), 3), error) ==
          DELOTET_STATUS_INVALID_ARGUMENT);
    const delotet::Mesh cube = delotet::tetrahedralize(
        delotet::Plc(std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}})
            .add_triangles(std::vector<delotet::Triangle>{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}));
    delotet::Voronoi none;
    CHECK(cube.voronoi(options, none, error) == DELOTET_STATUS_UNSUPPORTED && none.get() == nullptr);
    CHECK(none.cells().empty() && none.vertices().empty());
    return 0;
}
