// The cost of a call: 10,000 cubes of twelve triangles from PLC to mesh. The figure is only printed; the test is that every call gives the
// same mesh.
#include "test.hpp"

#include <chrono>

int main()
{
    const std::vector<Point> points = box_points(0, 1);
    const std::vector<Index> corners = box_corners();
    const int calls = 10000;
    std::size_t tets = 0, first = 0;
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < calls; i++) {
        delotet::Plc plc(points);
        plc.add_triangles(corners);
        const delotet::Mesh mesh = delotet::tetrahedralize(plc);
        if (i == 0)
            first = mesh.tets().size();
        CHECK(mesh.tets().size() == first);
        tets += first;
    }
    const std::chrono::duration<double, std::micro> time = std::chrono::steady_clock::now() - start;
    std::printf("%.1f microseconds per cube, %.1f tetrahedra each\n", time.count() / calls,
                static_cast<double>(tets) / calls);
    CHECK(first == 5 || first == 6);
    return 0;
}
