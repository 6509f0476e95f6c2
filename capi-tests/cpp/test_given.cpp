// Meshes that are given: arrays, files, sizes, refining and improving, with and without exceptions.
#include "test.hpp"

#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

static const double infinity = std::numeric_limits<double>::infinity();
static const Point points[] = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {4, 4, 4}, {9, 9, 9}};
static const delotet::Tet tets[] = {{0, 1, 2, 3}, {1, 2, 3, 4}};

static delotet::MeshArrays two_tets()
{
    delotet::MeshArrays arrays;
    arrays.points = points;
    arrays.tets = tets;
    return arrays;
}

static void arrays()
{
    static const double material[] = {2, 1};
    static const delotet::Triangle faces[] = {{0, 1, 2}};
    static const delotet::Marker marks[] = {7};
    static const std::array<Index, 2> edges[] = {{1, 2}};
    delotet::MeshArrays given = two_tets();
    given.attributes = material;
    given.faces = faces;
    given.face_markers = marks;
    given.edges = edges;
    given.edge_markers = marks;
    const delotet::Mesh mesh = delotet::mesh_from_arrays(given);
    CHECK(mesh.tets().size() == 2 && mesh.subfaces().size() == 7 && mesh.regions().size() == 2);
    CHECK(mesh.subfaces()[0].marker == 7 && mesh.subsegments()[0].marker == 7 && mesh.input_point_count() == 6);
    CHECK(mesh.unmeshed_points().size() == 1 && std::abs(volume(mesh) - 32) < 1e-12);
    given.input_point_count = 0;
    CHECK(delotet::mesh_from_arrays(given).input_point_count() == 5);

    delotet::Error error;
    delotet::Mesh none;
    given.face_markers = {};
    CHECK(delotet::mesh_from_arrays(given, {}, none, error) == DELOTET_STATUS_OK && none.subfaces()[0].marker == 0);
    given.attributes = delotet::Span<const double>(material, 1);
    CHECK(delotet::mesh_from_arrays(given, {}, none, error) == DELOTET_STATUS_INVALID_ARGUMENT);
    static const delotet::Tet flat[] = {{0, 1, 2, 2}};
    delotet::MeshArrays bad = two_tets();
    bad.tets = flat;
    CHECK(delotet::mesh_from_arrays(bad, {}, none, error) == DELOTET_STATUS_CHECK_FAILED && none.get() == nullptr);
    CHECK(error.defects()[0].kind == DELOTET_DEFECT_KIND_NOT_POSITIVE);
    CHECK(caught<delotet::Exception>([&] { delotet::mesh_from_arrays(bad); }).status() == DELOTET_STATUS_CHECK_FAILED);
}

static void sizes()
{
    const delotet::Mesh mesh = delotet::mesh_from_arrays(two_tets());
    const auto count = [&](const delotet::MeshSizes &wanted) {
        const delotet::Mesh refined = delotet::refine(mesh, wanted);
        return refined.points().size();
    };
    const std::size_t none = count(delotet::MeshSizes());
    CHECK(none < count(delotet::MeshSizes().points(std::vector<double>{0.5, infinity, infinity, infinity, infinity, infinity})));
    CHECK(none < count(delotet::MeshSizes().tets(std::vector<double>{0.5, infinity})));
    CHECK(none < count(delotet::MeshSizes().facet(0, 0.5)) && none < count(delotet::MeshSizes().region(1, 0.5)));
    CHECK(none < count(delotet::MeshSizes().facet_area(0, 0.1)));
    delotet::MeshSizes wanted;
    wanted.points(std::vector<double>(6, 0.5)).segment(3, 0.5).facet(0, 0.5).facet(0, infinity).region(1, 1);
    delotet::Error error;
    CHECK(wanted.points(std::vector<double>(6, 0), error) == DELOTET_STATUS_INVALID_ARGUMENT);
    CHECK(wanted.tets(std::vector<double>(6, -1), error) == DELOTET_STATUS_INVALID_ARGUMENT);
    CHECK(wanted.facet(0, 0, error) == DELOTET_STATUS_INVALID_ARGUMENT);
    CHECK(wanted.segment(0, NAN, error) == DELOTET_STATUS_INVALID_ARGUMENT);
    CHECK(wanted.region(NAN, 1, error) == DELOTET_STATUS_INVALID_ARGUMENT);
    delotet::Mesh fine;
    CHECK(delotet::refine(mesh, wanted, {}, fine, error) == DELOTET_STATUS_OK && fine.points().size() > none);
    wanted.points(std::vector<double>(7, 0.5));
    CHECK(delotet::refine(mesh, wanted, {}, fine, error) == DELOTET_STATUS_INVALID_ARGUMENT && fine.get() == nullptr);
    const delotet::MeshSizes moved = std::move(wanted);
    CHECK(caught<delotet::Exception>([&] { delotet::refine(mesh, moved); }).status() == DELOTET_STATUS_INVALID_ARGUMENT);
    CHECK(wanted.facet(1, 1, error) == DELOTET_STATUS_OUT_OF_MEMORY); // NOLINT: moved from, it is empty.
}

static void refining()
{
    const delotet::Plc plc = cube();
    const delotet::Mesh mesh = delotet::tetrahedralize(plc, delotet::Options().mode(delotet::Mode::preserve));
    const delotet::Mesh fine = delotet::refine(mesh, delotet::Options().size(0.3));
    fine.check_preserved(plc);
    CHECK(fine.points().size() > mesh.points().size() && std::abs(volume(fine) - volume(mesh)) < 1e-12);
    const delotet::Mesh better = delotet::improve(fine, delotet::Options().optimize(2));
    better.check_preserved(plc);
    CHECK(better.quality_summary().worst[DELOTET_QUALITY_MIN_DIHEDRAL] >= fine.quality_summary().worst[DELOTET_QUALITY_MIN_DIHEDRAL]);
    // What a callback throws arrives.
    const auto thrown = delotet::Options().size_function([](const Point &) -> double { throw std::string("no size"); });
    CHECK(caught<std::string>([&] { delotet::refine(mesh, thrown); }) == "no size");
    fine.write(plc, "given.mesh");
    const delotet::Mesh read = delotet::read_mesh("given.mesh");
    CHECK(read.tets().size() == fine.tets().size() && read.subfaces().size() == fine.subfaces().size());
    std::remove("given.mesh");
    CHECK(caught<delotet::Exception>([] { delotet::read_mesh("given.mesh"); }).status() == DELOTET_STATUS_FILE);
    delotet::Error error;
    delotet::Mesh none;
    CHECK(delotet::improve(delotet::Mesh(), {}, none, error) == DELOTET_STATUS_INVALID_ARGUMENT && none.get() == nullptr);
    CHECK(delotet::read_mesh("given.off", {}, none, error) == DELOTET_STATUS_UNSUPPORTED);
}

int main()
{
    arrays();
    sizes();
    refining();
    return 0;
}
