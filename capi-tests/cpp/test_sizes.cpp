// Points inside by size and shape: the options, sizes of parts of the input, and size functions, which may throw.
#include "test.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <thread>

static const double infinity = std::numeric_limits<double>::infinity();

/// A box from 0 to 6 whose sides are cut into unit squares of two triangles each, so that there is room inside.
static delotet::Plc grid_box()
{
    std::vector<Point> points;
    std::vector<Index> corners;
    const auto index = [&](const Point &at) {
        for (std::size_t i = 0; i < points.size(); i++)
            if (points[i] == at)
                return static_cast<Index>(i);
        points.push_back(at);
        return static_cast<Index>(points.size() - 1);
    };
    const double step[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
    for (std::size_t side = 0; side < 6; side++)
        for (int i = 0; i < 36; i++)
            for (const auto &corner : step) {
                Point at;
                at[side / 2] = side % 2 ? 6 : 0;
                at[(side / 2 + 1) % 3] = i / 6 + corner[0];
                at[(side / 2 + 2) % 3] = i % 6 + corner[1];
                corners.push_back(index(at));
            }
    return delotet::Plc(points).add_triangles(corners);
}

static delotet::Options preserving()
{
    return delotet::Options().mode(delotet::Mode::preserve);
}

static void settings()
{
    delotet::Options options;
    CHECK(options.size() == 0 && options.max_volume() == 0 && options.gradation() == 0.3 && options.quality() == 0);
    CHECK(options.optimize() == 0 && !options.size_function());
    options.size(0.5).max_volume(0.25).gradation(0.125).quality(2).optimize(3);
    CHECK(options.size() == 0.5 && options.max_volume() == 0.25 && options.gradation() == 0.125);
    CHECK(options.quality() == 2 && options.optimize() == 3);
    delotet::Error error;
    CHECK(options.size(-1, error) == DELOTET_STATUS_INVALID_ARGUMENT && options.size() == 0.5);
    CHECK(options.max_volume(infinity, error) == DELOTET_STATUS_INVALID_ARGUMENT && options.max_volume() == 0.25);
    CHECK(options.gradation(2, error) == DELOTET_STATUS_INVALID_ARGUMENT && options.gradation() == 0.125);
    CHECK(options.quality(0.9, error) == DELOTET_STATUS_INVALID_ARGUMENT && options.quality() == 2);
    CHECK(options.optimize(0, error) == DELOTET_STATUS_OK && options.optimize() == 0);
    CHECK(options.min_angle() == 0 && options.min_angle(20).min_angle() == 20);
    CHECK(options.min_angle(61, error) == DELOTET_STATUS_INVALID_ARGUMENT && options.min_angle() == 20);
    CHECK(delotet::Options(delotet::Options().min_angle(30)).min_angle() == 30);
    CHECK(options.optimize_seconds() == 0 && options.optimize_seconds(2.5).optimize_seconds() == 2.5);
    CHECK(options.optimize_seconds(-1, error) == DELOTET_STATUS_INVALID_ARGUMENT && options.optimize_seconds() == 2.5);
    CHECK(delotet::Options(delotet::Options().optimize_seconds(1)).optimize_seconds() == 1);
    CHECK(caught<delotet::Exception>([&] { options.quality(0.5); }).status() == DELOTET_STATUS_INVALID_ARGUMENT);
    const delotet::Options moved = delotet::Options().size(2).max_volume(3).gradation(1).quality(1.2).optimize(1);
    CHECK(moved.size() == 2 && moved.max_volume() == 3 && moved.gradation() == 1 && moved.quality() == 1.2);
    CHECK(moved.optimize() == 1);
}

static void parts_of_the_input()
{
    const std::vector<double> sizes = {1, 2, 3, 4, 5, 6, 7, infinity};
    delotet::Plc plc = cube().set_point_sizes(sizes).set_facet_size(4, 0.5).set_segment_size(-2, 0.25).set_region_size(1.5, 8);
    CHECK(plc.point_sizes().size() == 8 && plc.point_sizes()[6] == 7 && plc.point_sizes()[7] == infinity);
    CHECK(plc.facet_size(4) == 0.5 && plc.segment_size(-2) == 0.25 && plc.region_size(1.5) == 8);
    CHECK(plc.facet_size(5) == infinity && plc.segment_size(4) == infinity && plc.region_size(1) == infinity);
    CHECK(plc.set_facet_area(4, 2).facet_area(4) == 2 && plc.facet_size(4) == 0.5 && plc.facet_area(5) == infinity);
    delotet::Error error;
    CHECK(plc.set_facet_area(4, -1, error) == DELOTET_STATUS_INVALID_ARGUMENT && plc.facet_area(4) == 2);
    CHECK(delotet::Plc(cube().set_facet_area(1, 3)).facet_area(1) == 3);
    CHECK(plc.set_point_sizes(std::vector<double>(7, 1), error) == DELOTET_STATUS_INVALID_ARGUMENT);
    CHECK(plc.set_facet_size(4, 0, error) == DELOTET_STATUS_INVALID_ARGUMENT && plc.facet_size(4) == 0.5);
    CHECK(plc.set_segment_size(-2, -1, error) == DELOTET_STATUS_INVALID_ARGUMENT);
    CHECK(plc.set_region_size(NAN, 1, error) == DELOTET_STATUS_INVALID_ARGUMENT);
    const delotet::Plc copy = plc.clone();
    plc.set_point_sizes({}).set_facet_size(4, infinity).set_segment_size(-2, infinity).set_region_size(1.5, infinity);
    CHECK(plc.point_sizes().empty() && plc.facet_size(4) == infinity && plc.segment_size(-2) == infinity);
    CHECK(plc.region_size(1.5) == infinity && copy.region_size(1.5) == 8 && copy.point_sizes().size() == 8);
}

static void meshes()
{
    const delotet::Plc plc = grid_box();
    const auto points = [&](const delotet::Options &options) {
        const delotet::Mesh mesh = delotet::tetrahedralize(plc, options);
        mesh.check_preserved(plc);
        CHECK(std::abs(volume(mesh) - 216) < 1e-9);
        return mesh.points().size();
    };
    const std::size_t none = points(preserving()), fine = points(preserving().size(0.5));
    const auto half = [](const Point &at) { return at[0] < 3 ? 0.5 : infinity; };
    const std::size_t fine_in_half = points(preserving().size_function(half));
    CHECK(none < fine_in_half && fine_in_half < fine);
    CHECK(none < points(preserving().quality(2).optimize(1)));
}

static void functions_that_throw()
{
    const delotet::Plc plc = grid_box();
    int calls = 0;
    delotet::Options options = preserving().size_function([&](const Point &) -> double {
        if (++calls == 3)
            throw std::string("no size");
        return 0.5;
    });
    CHECK(caught<std::string>([&] { delotet::tetrahedralize(plc, options); }) == "no size");
    CHECK(calls == 3); // Cancelled at once.
    delotet::Error error;
    delotet::Mesh mesh;
    calls = 2;
    CHECK(caught<std::string>([&] { delotet::tetrahedralize(plc, options, mesh, error); }) == "no size");
    // What is no length is an error of the library's.
    options.size_function([](const Point &) { return -1.0; });
    CHECK(delotet::tetrahedralize(plc, options, mesh, error) == DELOTET_STATUS_INVALID_ARGUMENT && mesh.get() == nullptr);
    CHECK(options.size_function() && options.size_function(nullptr, error) == DELOTET_STATUS_OK && !options.size_function());
    CHECK(delotet::tetrahedralize(plc, options, mesh, error) == DELOTET_STATUS_OK);

    // A function that makes a mesh itself: every exception arrives at its own call.
    delotet::Options inner = preserving().size_function([](const Point &) -> double { throw 7; });
    bool asked = false;
    options.size_function([&](const Point &) {
        if (!asked)
            CHECK(caught<int>([&] { delotet::tetrahedralize(plc, inner); }) == 7);
        asked = true;
        return infinity;
    });
    delotet::tetrahedralize(plc, options);
    CHECK(asked);

    // One set of options in several threads: every exception arrives where it was thrown.
    const delotet::Options shared =
        preserving().size_function([](const Point &) -> double { throw std::this_thread::get_id(); });
    std::vector<std::thread> threads;
    for (int i = 0; i < 3; i++)
        threads.emplace_back([&] {
            const auto id = caught<std::thread::id>([&] { delotet::tetrahedralize(plc, shared); });
            CHECK(id == std::this_thread::get_id());
        });
    for (std::thread &thread : threads)
        thread.join();
}

static void background()
{
    const delotet::Plc plc = grid_box();
    delotet::Options options = preserving();
    CHECK(options.background().empty());
    {
        const delotet::Mesh coarse = delotet::tetrahedralize(plc);
        std::vector<double> sizes(coarse.points().size(), 0.7);
        sizes[3] = infinity;
        options.background(coarse, sizes);
        CHECK(options.background().size() == sizes.size() && options.background()[4] == 0.7);
        delotet::Error error;
        sizes[5] = 0;
        CHECK(options.background(coarse, sizes, error) == DELOTET_STATUS_INVALID_ARGUMENT && options.background()[5] == 0.7);
        CHECK(std::string(error.message()).find("point 5 ") != std::string::npos);
        sizes.pop_back();
        CHECK(caught<delotet::Exception>([&] { options.background(coarse, sizes); }).status() == DELOTET_STATUS_INVALID_ARGUMENT);
        const delotet::Options chained = delotet::Options().background(coarse, std::vector<double>(coarse.points().size(), 2));
        CHECK(chained.background()[0] == 2);
    }
    // The mesh is gone.
    const delotet::Mesh fine = delotet::tetrahedralize(plc, options);
    const delotet::Mesh plain = delotet::tetrahedralize(plc, options.no_background());
    CHECK(fine.points().size() > plain.points().size() && options.background().empty());
}

int main()
{
    background();
    settings();
    parts_of_the_input();
    meshes();
    functions_that_throw();
    return 0;
}
