// With -fno-exceptions: everything by statuses.
#include "test.hpp"

#include <cmath>

#if DELOTET_EXCEPTIONS
#error "this test is about -fno-exceptions"
#endif

int main()
{
    delotet::Error error;
    delotet::Plc plc;
    CHECK(delotet::Plc::create(box_points(0, 1), plc, error) == DELOTET_STATUS_OK && !error);
    CHECK(plc.add_triangles(box_corners(), {}, error) == DELOTET_STATUS_OK);
    CHECK(plc.add_segment(0, 1, 3, error) == DELOTET_STATUS_OK);
    int calls = 0;
    delotet::Options options;
    options.on_progress([&](delotet::Phase, double) { return ++calls > 0; });
    CHECK(options.merge_facets(17, error) == DELOTET_STATUS_INVALID_ARGUMENT && error && error.message()[0] != '\0');
    CHECK(options.merge_facets() == 0);
    CHECK(options.size(-1, error) == DELOTET_STATUS_INVALID_ARGUMENT && options.size() == 0);
    CHECK(options.size_function([](const Point &) { return 1.0; }, error) == DELOTET_STATUS_OK && options.size_function());
    CHECK(options.size_function(nullptr, error) == DELOTET_STATUS_OK);
    CHECK(options.threads(2, error) == DELOTET_STATUS_OK && !error && options.threads() == 2);
    delotet::Mesh mesh;
    CHECK(delotet::tetrahedralize(plc, options, mesh, error) == DELOTET_STATUS_OK && calls > 0);
    CHECK(std::abs(volume(mesh) - 1) < 1e-15);
    delotet::Records<delotet::Edge> edges;
    CHECK(mesh.edges(edges, error) == DELOTET_STATUS_OK && edges.size() >= 18);

    CHECK(plc.add_segment(0, 99, 0, error) == DELOTET_STATUS_INDEX_OUT_OF_RANGE);
    CHECK(error && error.defects().size() == 1 && error.defects()[0].second == 99);
    CHECK(plc.add_triangles(std::vector<Index>(4), {}, error) == DELOTET_STATUS_INVALID_ARGUMENT);
    CHECK(error && error.defects().empty() && error.message()[0] != '\0');
    options.on_progress([](delotet::Phase, double) { return false; });
    CHECK(delotet::tetrahedralize(plc, options, mesh, error) == DELOTET_STATUS_CANCELLED && mesh.get() == nullptr);
    CHECK(delotet::Plc::create(box_points(0, 1), plc, error) == DELOTET_STATUS_OK && !error);
    return 0;
}
