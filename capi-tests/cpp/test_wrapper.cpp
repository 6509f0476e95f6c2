// The wrapper: every method once, against a PLC whose answers are known.
#include "test.hpp"

#include <algorithm>
#include <cmath>
#include <string>

static void inputs()
{
    delotet::Plc plc = cube();
    CHECK(plc.points().size() == 8 && plc.points()[7] == Point{1, 1, 1});
    CHECK(plc.facet_count() == 12 && plc.segment_count() == 0 && plc.facet_marker(3) == 0);
    const Index ends[] = {0, 1, 1, 3};
    plc.add_segment(0, 2, 5).add_segments(ends).add_segments(ends, std::vector<Marker>{1, 2});
    CHECK(plc.segment_count() == 5);
    plc.set_point_attributes(std::vector<double>(16, 1.5)).set_point_markers(std::vector<Marker>(8, 4));
    const delotet::Mesh mesh = delotet::tetrahedralize(plc);
    CHECK(mesh.point_attributes().width == 2 && mesh.point_attributes().data[15] == 1.5);
    CHECK(mesh.point_markers().size() == mesh.points().size() && mesh.point_markers()[7] == 4);

    delotet::Plc moved = std::move(plc);
    CHECK(plc.get() == nullptr && plc.points().empty() && moved.points().size() == 8);
    plc = std::move(moved);
    CHECK(plc.points().size() == 8);
    const delotet::Plc none(std::vector<Point>{});
    CHECK(none.points().empty());
}

static void facets()
{
    // A box with a tunnel: facets with a ring inside, once by rings and once by seeds.
    std::vector<Point> points = box_points(0, 3);
    for (Point point : box_points(1, 2)) {
        point[2] = point[2] == 1 ? 0 : 3;
        points.push_back(point);
    }
    const Index bottom[] = {0, 2, 3, 1, 8, 10, 11, 9}, top[] = {4, 5, 7, 6, 12, 13, 15, 14};
    const Index walls[] = {0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5,
                           8, 12, 13, 9, 10, 11, 15, 14, 8, 10, 14, 12, 9, 13, 15, 11};
    const std::size_t two[] = {4, 8}, eight[] = {4, 8, 12, 16, 20, 24, 28, 32};
    const Point low[] = {{1.5, 1.5, 0}}, high[] = {{1.5, 1.5, 3}};
    delotet::Plc rings(points), seeds(points);
    rings.add_facet(bottom, two, 1).add_facet(top, two, 2).add_polygons(walls, eight);
    seeds.add_facet_with_hole_seeds(bottom, two, low, 1).add_facet_with_hole_seeds(top, two, high, 2);
    seeds.add_polygons(walls, eight, std::vector<Marker>(8, 3));
    CHECK(std::abs(volume(delotet::tetrahedralize(rings)) - 24) < 1e-12);
    CHECK(std::abs(volume(delotet::tetrahedralize(seeds)) - 24) < 1e-12);
}

static void outputs()
{
    delotet::Plc plc = nested_boxes();
    plc.add_region({0.5, 0.5, 0.5}, 10).add_region({1.5, 1.5, 1.5}, 20, 0.125);
    plc.check();
    const delotet::Mesh mesh = delotet::tetrahedralize(plc);
    mesh.check(plc);
    CHECK(std::abs(volume(mesh) - 27) < 1e-12);
    CHECK(mesh.input_point_count() == 16 && mesh.point_aliases().size() == 16);
    CHECK(mesh.neighbors().size() == mesh.tets().size() && mesh.tet_regions().size() == mesh.tets().size());
    CHECK(mesh.regions().size() == 2 && mesh.subfaces().size() >= 24 && !mesh.subsegments().empty());
    CHECK(mesh.steiner_points().size() == mesh.points().size() - 16 && mesh.facet_flips().empty());
    CHECK(mesh.stats().struct_size == sizeof(delotet::Stats));
    const auto attributes = mesh.tet_attributes();
    for (std::size_t tet = 0; tet < attributes.size(); tet++)
        CHECK(attributes[tet] == mesh.regions()[mesh.tet_regions()[tet]].attribute);
    CHECK(mesh.point_tets().size() == mesh.points().size());
    CHECK(mesh.points().size() + mesh.faces().size() == 1 + mesh.edges().size() + mesh.tets().size());
    CHECK(mesh.tet_faces().size() == mesh.tets().size() && mesh.tet_edges().size() == mesh.tets().size());
    CHECK(mesh.subface_edges().size() == mesh.subfaces().size());
    const delotet::SecondOrder second = mesh.second_order(delotet::NodeOrder::vtk);
    CHECK(second.nodes.size() == mesh.edges().size() && second.tets.size() == mesh.tets().size());

    const std::vector<Point> where = {{0.25, 0.5, 0.75}, {1.5, 1.5, 1.25}, {5, 5, 5}};
    std::vector<Index> tets(3);
    std::vector<std::array<double, 4>> weights(3);
    mesh.locate(where, tets, weights);
    CHECK(attributes[tets[0]] == 10 && attributes[tets[1]] == 20 && tets[2] == delotet::invalid_index);
    CHECK(std::abs(weights[0][0] + weights[0][1] + weights[0][2] + weights[0][3] - 1) < 1e-15);

    plc.add_hole({1.5, 1.5, 1.5});
    // The seed of a region inside a hole is a contradiction.
    delotet::Error error;
    delotet::Mesh carved;
    CHECK(delotet::tetrahedralize(plc, {}, carved, error) == DELOTET_STATUS_SEED_OUTSIDE && carved.get() == nullptr);
    CHECK(error.status() == DELOTET_STATUS_SEED_OUTSIDE && error.defects().size() == 1);
    CHECK(error.defects()[0].kind == DELOTET_DEFECT_KIND_SEED_OUTSIDE);
    CHECK(error.defects()[0].first_element == DELOTET_ELEMENT_REGION && error.defects()[0].first == 1);
    plc = nested_boxes();
    plc.add_region({0.5, 0.5, 0.5}, 10).add_hole({1.5, 1.5, 1.5});
    carved = delotet::tetrahedralize(plc);
    CHECK(std::abs(volume(carved) - 26) < 1e-12 && carved.regions().size() == 1);
}

static void files()
{
    delotet::Plc plc = cube();
    delotet::tetrahedralize(plc).write(plc, "cxx_wrapper.vtk");
    std::FILE *file = std::fopen("cxx_wrapper.vtk", "r");
    CHECK(file != nullptr);
    std::fclose(file);
    std::remove("cxx_wrapper.vtk");

    delotet::WriteOptions options;
    options.compress(true).subfaces(true).quality_data(true).second_order(true).msh_version(delotet::MshVersion::v2_2).region_name(1, "steel");
    CHECK(options.compress() && options.subfaces() && options.quality_data() && options.second_order());
    CHECK(options.msh_version() == delotet::MshVersion::v2_2 && std::strcmp(options.region_name(1), "steel") == 0);
    std::string told;
    options.on_log([&](const char *line) { told += line; });
    const delotet::Mesh mesh = delotet::tetrahedralize(plc);
    mesh.write(plc, "cxx_wrapper.msh", options);
    CHECK(told.find("compress has no effect") != std::string::npos);
    char line[64] = "";
    file = std::fopen("cxx_wrapper.msh", "r");
    CHECK(file != nullptr);
    CHECK(std::fgets(line, sizeof line, file) && std::fgets(line, sizeof line, file));
    std::fclose(file);
    CHECK(std::strcmp(line, "2.2 0 8\n") == 0);
    std::remove("cxx_wrapper.msh");
    delotet::Error error;
    CHECK(mesh.write(plc, "cxx_wrapper.mesh", options, error) == DELOTET_STATUS_UNSUPPORTED);
    CHECK(mesh.write(plc, "cxx_wrapper.vtu", delotet::WriteOptions().compress(true), error) == DELOTET_STATUS_OK);
    std::remove("cxx_wrapper.vtu");

    told.clear();
    const delotet::Marker markers[8] = {0, 0, 5};
    delotet::WriteOptions telling;
    telling.on_log([&](const char *text) { told += text; });
    plc.set_point_markers(markers).write("cxx_wrapper.off", telling);
    CHECK(told.find("point 2") != std::string::npos);
    CHECK(plc.write("cxx_wrapper.vtu", telling, error) == DELOTET_STATUS_UNSUPPORTED);
    telling.on_log([](const char *) { throw std::string("log"); });
    CHECK(caught<std::string>([&] { plc.write("cxx_wrapper.off", telling); }) == "log");
    CHECK(std::remove("cxx_wrapper.off") == 0);
}

static void options()
{
    delotet::Options options;
    options.mode(delotet::Mode::delaunay).threads(2).max_defects(5).validate(true).points_sorted(false);
    options.keep_hull(true).merge_facets(0).steiner_limit(17).exact_form(true).preserve(delotet::Preserve::outer);
    CHECK(options.mode() == delotet::Mode::delaunay && options.threads() == 2 && options.max_defects() == 5);
    CHECK(options.validate() && !options.points_sorted() && options.keep_hull() && options.merge_facets() == 0);
    CHECK(options.steiner_limit() == 17 && options.exact_form() && options.preserve() == delotet::Preserve::outer);
    CHECK(options.tetrahedra_limit() == UINT64_MAX && options.tetrahedra_limit(9).tetrahedra_limit() == 9);
    options.steiner_limit(UINT64_MAX).tetrahedra_limit(UINT64_MAX).exact_form(false);
    const delotet::Mesh mesh = delotet::tetrahedralize(delotet::Plc(random_points(500)), options);
    CHECK(mesh.points().size() == 500 && mesh.subfaces().empty());
    delotet::Options moved = std::move(options);
    const delotet::Mesh again = delotet::tetrahedralize(delotet::Plc(random_points(500)), moved);
    CHECK(again.tets().size() == mesh.tets().size());
}

/// Records larger than in this header, like those of a later library: the stride is used, not the size.
static void records()
{
    struct Larger {
        delotet::Subsegment known;
        double more;
    };
    Larger list[5] = {};
    for (Index i = 0; i < 5; i++) {
        list[i].known.segment = i;
        list[i].more = -1;
    }
    const delotet::Records<delotet::Subsegment> view(&list[0].known, 5, sizeof(Larger));
    CHECK(view.size() == 5 && !view.empty() && view.stride() == sizeof(Larger) && view[3].segment == 3);
    Index next = 0;
    for (const delotet::Subsegment &piece : view)
        CHECK(piece.segment == next++);
    CHECK(next == 5 && view.end() - view.begin() == 5 && view.begin()[4].segment == 4);
    const auto found = std::lower_bound(view.begin(), view.end(), 2, [](const delotet::Subsegment &piece, int segment) {
        return piece.segment < static_cast<Index>(segment);
    });
    CHECK(found - view.begin() == 2 && found->segment == 2 && (found + 1)->segment == 3 && found < view.end());
    CHECK(std::distance(std::make_reverse_iterator(view.end()), std::make_reverse_iterator(view.begin())) == 5);
    const delotet::Records<delotet::Subsegment> none;
    CHECK(none.empty() && none.begin() == none.end() && none.end() - none.begin() == 0);
    const DelotetSubsegmentsView c = {&list[0].known, 5, sizeof(Larger)};
    CHECK(reinterpret_cast<const char *>(c.first) + 2 * c.stride == reinterpret_cast<const char *>(&list[2]));
}

/// A wedge of 10 degrees: the tetrahedra in it are forced by the two facets.
static void quality()
{
    const double angle = 10 * std::acos(-1.0) / 180, x = std::cos(angle), y = std::sin(angle);
    const std::vector<Point> points = {{0, 0, 0}, {1, 0, 0}, {x, y, 0}, {0, 0, 1}, {1, 0, 1}, {x, y, 1}};
    const std::vector<Index> corners = {0, 2, 1, 3, 4, 5, 0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 2, 0, 3, 2, 3, 5};
    const delotet::Mesh mesh = delotet::tetrahedralize(delotet::Plc(points).add_triangles(corners));
    const delotet::QualitySummary summary = mesh.quality_summary();
    CHECK(summary.tet_count == mesh.tets().size() && mesh.quality().size() == mesh.tets().size());
    CHECK(mesh.forced_tets().size() == summary.forced_count && summary.forced_count > 0);
    for (const delotet::ForcedTet &forced : mesh.forced_tets())
        CHECK(std::abs(forced.angle - 10) < 1e-12 && forced.facets[0] / 2 == 1 && forced.facets[1] / 2 == 3);
    const delotet::SkinnyTets skinny = mesh.skinny_tets(1);
    CHECK(skinny.ratio() == 1 && skinny.tets().size() > 0 && mesh.skinny_tets().ratio() == 2);
    std::size_t count = 0;
    for (const delotet::TetQuality &tet : mesh.quality())
        count += tet.radius_edge > 1;
    CHECK(skinny.tets().size() == count && skinny.count(delotet::SkinnyCause::wedge) > 0);
    for (const delotet::SkinnyTet &tet : skinny.tets())
        CHECK(tet.cause == DELOTET_SKINNY_OTHER || tet.facets[0] != delotet::invalid_index);
    Index worst[2] = {};
    mesh.worst_tets(delotet::QualityMeasure::min_dihedral, false, worst);
    CHECK(worst[0] == summary.worst_tets[DELOTET_QUALITY_MIN_DIHEDRAL]);
    mesh.worst_tets(delotet::QualityMeasure::eta, true, worst);
    CHECK(worst[0] == summary.unforced_worst_tets[DELOTET_QUALITY_ETA]);
    CHECK(delotet::quality_bin_edges(delotet::QualityMeasure::min_dihedral).size() == DELOTET_QUALITY_BINS + 1);
}

static void preserve()
{
    delotet::Options options;
    options.mode(delotet::Mode::preserve).preserve(delotet::Preserve::outer);
    bool seen = false;
    options.on_progress([&](delotet::Phase phase, double) {
        seen = seen || phase == DELOTET_PHASE_PRESERVE;
        return true;
    });
    const delotet::Plc plc = twisted_prism();
    const delotet::Mesh mesh = delotet::tetrahedralize(plc, options);
    mesh.check_preserved(plc);
    mesh.check_preserved_outer(plc);
    CHECK(seen && mesh.points().size() == 7 && mesh.subfaces().size() == 8);
    CHECK(mesh.steiner_points().size() == 1 && mesh.steiner_points()[0].ends[0] == delotet::invalid_index);
    CHECK(mesh.stats().preserve_interior == 1 && mesh.stats().preserve_on_internal_facets == 0);
    delotet::Error error;
    const delotet::Mesh split = delotet::tetrahedralize(plc);
    CHECK(split.check_preserved(plc, 2, error) == DELOTET_STATUS_CHECK_FAILED);
    CHECK(!error.defects().empty() && error.defects().size() <= 2);
    CHECK(std::abs(volume(mesh) - volume(split)) < 1e-12);
}

static void warnings()
{
    std::vector<Point> points = box_points(0, 1);
    points.push_back({2, 0, 0});
    std::vector<Index> corners = box_corners();
    corners.insert(corners.end(), {1, 3, 8});
    delotet::Plc plc(points);
    plc.add_triangles(corners);
    std::vector<std::string> lines;
    delotet::Options options;
    options.on_log([&](const char *line) { lines.push_back(line); });
    const delotet::Mesh mesh = delotet::tetrahedralize(plc, options);
    // Two open edges of the fin, its triangle and its point.
    CHECK(mesh.warnings().size() == 4 && lines.size() == 3);
    CHECK(mesh.warning_count(DELOTET_WARNING_KIND_OPEN_EDGE) == 2);
    CHECK(mesh.warnings()[0].kind == DELOTET_WARNING_KIND_OPEN_EDGE && mesh.warnings()[0].first == 1);
    CHECK(mesh.subfaces().size() == 12 && mesh.unmeshed_subfaces().size() == 1);
    CHECK(mesh.unmeshed_subsegments().size() == 2 && mesh.unmeshed_points().size() == 1);
    CHECK(mesh.point_map().empty());
    const delotet::Mesh dropped = delotet::tetrahedralize(plc, options.drop_unmeshed_points(true));
    CHECK(options.drop_unmeshed_points() && dropped.points().size() == 8);
    CHECK(dropped.point_map().size() == 9 && dropped.point_map()[8] == delotet::invalid_index);
}

int main()
{
    CHECK(delotet::compatible());
    warnings();
    inputs();
    facets();
    outputs();
    files();
    options();
    records();
    preserve();
    quality();
    return 0;
}
