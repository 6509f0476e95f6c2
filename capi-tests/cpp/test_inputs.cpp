// Input through the wrapper, both ways: integers of any type, flat or in rows; paths of any type; PLCs read back, copied, changed, written.
#include "test.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

using delotet::Plc;

/// The corners of a box as integers of another type.
template <class T> static std::vector<T> corners_as()
{
    std::vector<T> corners;
    for (const Index corner : box_corners())
        corners.push_back(static_cast<T>(corner));
    return corners;
}

template <class T> static std::vector<std::array<T, 3>> rows_as()
{
    const std::vector<T> flat = corners_as<T>();
    std::vector<std::array<T, 3>> rows(flat.size() / 3);
    for (std::size_t i = 0; i < flat.size(); i++)
        rows[i / 3][i % 3] = flat[i];
    return rows;
}

template <class Corners> static void meshes(const Corners &corners)
{
    const Plc plc = Plc(box_points(0, 1)).add_triangles(corners);
    CHECK(plc.facet_count() == 12 && plc.facet_ring(11)[1] == 7);
    CHECK(std::abs(volume(delotet::tetrahedralize(plc)) - 1) < 1e-12);
}

template <class T> static void accepts()
{
    meshes(corners_as<T>());
    meshes(rows_as<T>());
    T array[12][3];
    for (std::size_t i = 0; i < 12; i++)
        for (std::size_t k = 0; k < 3; k++)
            array[i][k] = corners_as<T>()[3 * i + k];
    meshes(array);
}

/// An index that is negative, or too large for 32 bits, is refused like one that no point has; the facet is named.
template <class T> static void refuses(T wrong)
{
    std::vector<T> corners = corners_as<T>();
    corners[7] = wrong;
    Plc plc(box_points(0, 1));
    const auto e = caught<delotet::Exception>([&] { plc.add_triangles(corners); });
    CHECK(e.status() == DELOTET_STATUS_INDEX_OUT_OF_RANGE && e.defects().size() == 1);
    CHECK(e.defects()[0].first_element == DELOTET_ELEMENT_FACET && e.defects()[0].first == 2);
    CHECK(plc.facet_count() == 0);
}

static void integers()
{
    accepts<int>();
    accepts<unsigned>();
    accepts<long>();
    accepts<unsigned long>();
    accepts<long long>();
    accepts<short>();
    accepts<unsigned char>();
    refuses<int>(-1);
    refuses<int>(std::numeric_limits<int>::min());
    refuses<long long>(-1);
    refuses<long long>(0x100000000LL); // Its low half is 0.
    refuses<unsigned long long>(~0ULL);
    refuses<short>(-1);
    refuses<int>(8);

    const std::vector<std::array<int, 2>> ends = {{0, 7}, {1, 6}};
    const std::vector<int> squares = {0, 2, 3, 1, 4, 5, 7, 6}, last = {4, 8};
    Plc plc(box_points(0, 1));
    plc.add_segments(ends).add_polygons(squares, last, std::vector<int>{5, 6}).add_facet(std::vector<int>{0, 1, 5, 4}, std::vector<int>{4});
    CHECK(plc.segments().size() == 2 && plc.segments()[1].ends[1] == 6 && plc.facet_count() == 3);
    CHECK(plc.facet_ring(1).size() == 4 && plc.facet_ring(1)[2] == 7 && plc.facet_marker(1) == 6);
    const auto e = caught<delotet::Exception>([&] { plc.add_polygons(squares, std::vector<int>{-4, 8}); });
    CHECK(e.status() == DELOTET_STATUS_INVALID_ARGUMENT && plc.facet_count() == 3);
}

static void paths()
{
    const std::string text = "cxx_inputs.off";
    const std::filesystem::path path = text;
    const Plc plc = cube();
    plc.write(text);
    CHECK(Plc::read(path).facet_count() == 12 && Plc::read(text).facet_count() == 12);
    CHECK(Plc::read("cxx_inputs.off").facet_count() == 12);
    plc.write(path);
    const delotet::Mesh mesh = delotet::tetrahedralize(plc);
    const std::filesystem::path out = std::filesystem::path(".") / "cxx_inputs.vtk";
    mesh.write(plc, out);
    mesh.write(plc, out.string());
    CHECK(std::filesystem::file_size(out) > 0);
    std::filesystem::remove(out);
    std::filesystem::remove(path);
    delotet::Error error;
    CHECK(plc.write(std::string("no/such/folder.off"), error) == DELOTET_STATUS_FILE);
    const delotet::WriteOptions options = delotet::WriteOptions().region_name(2.5, std::string("steel"));
    CHECK(std::strcmp(options.region_name(2.5), "steel") == 0 && options.region_name(1) == nullptr);
}

static void read_back()
{
    const std::vector<Point> seeds = {{0.5, 0.25, 0}};
    const std::vector<Index> rings = {0, 2, 3, 1, 4, 5, 6};
    const std::vector<std::size_t> ends = {4, 7};
    Plc plc = cube();
    plc.add_facet(rings, ends, 3).add_facet_with_hole_seeds(rings, ends, seeds, 4).add_segment(0, 7, 9);
    plc.add_hole({1, 2, 3}).add_region({0.5, 0.5, 0.5}, 2.5, 0.25);
    CHECK(plc.triangles().size() == 12 && plc.triangles()[1][2] == 3 && plc.facet_count() == 14);
    CHECK(plc.facet_ring_count(0) == 1 && plc.facet_ring_count(12) == 2 && plc.facet_ring_count(14) == 0);
    CHECK(plc.facet_ring(12).size() == 4 && plc.facet_ring(12, 1).size() == 3 && plc.facet_ring(12, 1)[0] == 4);
    CHECK(plc.facet_rule(12) == delotet::FacetRule::rings && plc.facet_rule(13) == delotet::FacetRule::seeds);
    CHECK(plc.facet_hole_seeds(13).size() == 1 && plc.facet_hole_seeds(13)[0] == seeds[0]);
    CHECK(plc.segments().size() == 1 && plc.segments()[0].marker == 9);
    CHECK(plc.holes().size() == 1 && plc.holes()[0] == Point{1, 2, 3});
    CHECK(plc.regions().size() == 1 && plc.regions()[0].attribute == 2.5 && plc.regions()[0].max_volume == 0.25);
    CHECK(plc.point_markers().empty() && plc.point_attributes().width == 0);

    CHECK(plc.add_points(std::vector<Point>{{0.5, 0.5, 0.5}}) == 8 && plc.points().size() == 9);
    std::vector<Marker> markers(14);
    for (std::size_t i = 0; i < markers.size(); i++)
        markers[i] = 50 + static_cast<Marker>(i);
    plc.set_facet_markers(markers).set_facet_marker(5, -1).set_segment_markers(std::vector<Marker>{11});
    CHECK(plc.facet_marker(4) == 54 && plc.facet_marker(5) == -1 && plc.facet_marker(13) == 63);
    CHECK(plc.segments()[0].marker == 11);
    CHECK(caught<delotet::Exception>([&] { plc.set_facet_marker(14, 1); }).status() == DELOTET_STATUS_INDEX_OUT_OF_RANGE);
    CHECK(caught<delotet::Exception>([&] { plc.set_facet_markers(std::vector<Marker>(3)); }).status() ==
          DELOTET_STATUS_INVALID_ARGUMENT);

    plc.set_marker_name(-1, std::string("lid")).set_marker_name(54, "floor");
    CHECK(plc.marker_name_count() == 2 && plc.named_marker(1) == 54 && plc.marker_name(7) == nullptr);
    CHECK(std::strcmp(plc.marker_name(plc.facet_marker(5)), "lid") == 0);

    const Plc copy = plc.clone();
    plc = Plc();
    CHECK(plc.facet_count() == 0 && copy.facet_count() == 14 && copy.points().size() == 9 && copy.facet_marker(5) == -1);
    CHECK(copy.facet_hole_seeds(13).size() == 1 && copy.regions().size() == 1 && copy.holes().size() == 1);
    CHECK(caught<delotet::Exception>([&] { plc.clone(); }).status() == DELOTET_STATUS_INVALID_ARGUMENT);
}

int main()
{
    integers();
    paths();
    read_back();
    return 0;
}
