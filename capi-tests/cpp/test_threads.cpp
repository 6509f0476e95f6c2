// Many threads: on handles of their own, and on the same constant handles. All get the same bytes.
#include "test.hpp"

#include <thread>

static bool same(const delotet::Mesh &a, const delotet::Mesh &b)
{
    return a.tets().size() == b.tets().size() && a.points().size() == b.points().size() &&
           std::memcmp(a.tets().data(), b.tets().data(), a.tets().size() * sizeof(delotet::Tet)) == 0 &&
           std::memcmp(a.points().data(), b.points().data(), a.points().size() * sizeof(Point)) == 0;
}

int main()
{
    const delotet::Plc plc = nested_boxes();
    const delotet::Plc cloud(random_points(2000));
    delotet::Options options;
    options.mode(delotet::Mode::delaunay);
    const delotet::Mesh mesh = delotet::tetrahedralize(plc), big = delotet::tetrahedralize(cloud, options);
    std::vector<std::thread> threads;
    for (int i = 0; i < 16; i++)
        threads.emplace_back([&] {
            for (int round = 0; round < 4; round++) {
                CHECK(same(delotet::tetrahedralize(nested_boxes()), mesh));
                CHECK(same(delotet::tetrahedralize(plc), mesh));
                CHECK(same(delotet::tetrahedralize(cloud, options), big));
                CHECK(caught<delotet::Exception>([] { pierced().check(); }).status() ==
                      DELOTET_STATUS_SELF_INTERSECTION);
                // Derived arrays are made once, whichever thread asks first.
                CHECK(big.faces().begin() == big.faces().begin() && big.edges().begin() == big.edges().begin());
                std::vector<Index> tets(cloud.points().size());
                big.locate(cloud.points(), tets);
                for (Index tet : tets)
                    CHECK(tet != delotet::invalid_index);
            }
        });
    for (std::thread &thread : threads)
        thread.join();
    return 0;
}
