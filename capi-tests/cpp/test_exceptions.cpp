// Failures as exceptions: they carry status, message and all elements at fault, and may be copied and kept.
#include "test.hpp"

int main()
{
    const delotet::Exception crossing = caught<delotet::Exception>([] { delotet::tetrahedralize(pierced()); });
    CHECK(crossing.status() == DELOTET_STATUS_SELF_INTERSECTION);
    CHECK(std::strlen(crossing.what()) > 0 && crossing.defect_count() >= crossing.defects().size());
    bool seen = false;
    for (const delotet::Defect &defect : crossing.defects())
        seen = seen || (defect.first_element == DELOTET_ELEMENT_FACET && defect.second_element == DELOTET_ELEMENT_FACET &&
                        defect.first + defect.second == 4 && defect.has_point && defect.point[2] * defect.point[2] < 1e-20);
    CHECK(seen);
    const delotet::Exception copy = crossing;
    CHECK(&copy.defects()[0] == &crossing.defects()[0] && copy.what() == crossing.what());
    CHECK(caught<std::exception>([] { pierced().check(); }).what() != nullptr);

    // Misuse that only the wrapper can see: sizes that do not fit together.
    const auto invalid = [](auto &&call) {
        const delotet::Exception e = caught<delotet::Exception>(call);
        return e.status() == DELOTET_STATUS_INVALID_ARGUMENT && e.defects().empty() && e.what()[0] != '\0';
    };
    const std::vector<Marker> three(3);
    const std::size_t nine[] = {9};
    CHECK(invalid([&] { delotet::Plc(std::vector<double>(7)); }));
    CHECK(invalid([&] { cube().add_triangles(std::vector<Index>(7)); }));
    CHECK(invalid([&] { cube().add_triangles(box_corners(), three); }));
    CHECK(invalid([&] { cube().add_segments(std::vector<Index>(3)); }));
    CHECK(invalid([&] { cube().set_point_markers(three); }));
    CHECK(invalid([&] { cube().set_point_attributes(std::vector<double>(9)); }));
    CHECK(invalid([&] { cube().add_facet(box_corners(), nine); }));
    CHECK(invalid([&] { cube().add_polygons(std::vector<Index>(9, 0), nine, three); }));
    CHECK(invalid([&] {
        std::vector<Index> tets(2);
        delotet::tetrahedralize(cube()).locate(std::vector<Point>(1), tets);
    }));
    // A setter that refuses a value says which, and keeps the one before; empty handles are refused.
    delotet::Options options;
    options.max_defects(4);
    const delotet::Exception refused = caught<delotet::Exception>([&] { options.max_defects(3).merge_facets(17).threads(2); });
    CHECK(refused.status() == DELOTET_STATUS_INVALID_ARGUMENT && std::strstr(refused.what(), "merge_facets: 17"));
    CHECK(options.max_defects() == 3 && options.merge_facets() == 0 && options.threads() == 1);
    CHECK(invalid([&] { options.mode(static_cast<delotet::Mode>(9)); }));
    const delotet::Options moved = std::move(options);
    CHECK(caught<delotet::Exception>([&] { delotet::tetrahedralize(cube(), options); }).status() ==
          DELOTET_STATUS_OUT_OF_MEMORY);
    CHECK(invalid([] { delotet::tetrahedralize(delotet::Plc()); }));
    const delotet::Mesh none;
    CHECK(invalid([&] { none.faces(); }));
    CHECK(caught<delotet::Exception>([] { cube().add_segment(0, 8); }).status() == DELOTET_STATUS_INDEX_OUT_OF_RANGE);
    CHECK(caught<delotet::Exception>([] { delotet::Plc::read("no/such.off"); }).status() == DELOTET_STATUS_FILE);
    return 0;
}
