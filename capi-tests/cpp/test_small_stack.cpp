// A thread with a stack of 256 KiB: the engine does not recurse.
#include "test.hpp"

#include <pthread.h>

static void *work(void *)
{
    delotet::Options delaunay;
    delaunay.mode(delotet::Mode::delaunay);
    const delotet::Mesh cloud = delotet::tetrahedralize(delotet::Plc(random_points(20000)), delaunay);
    CHECK(cloud.tets().size() > 100000);
    // A row of equal boxes inside a box: deep floods through one region, and many facets.
    std::vector<Point> points = box_points(-1, 201);
    std::vector<Index> corners = box_corners();
    for (int box = 0; box < 200; box++) {
        const std::vector<Index> more = box_corners(static_cast<Index>(points.size()));
        corners.insert(corners.end(), more.begin(), more.end());
        for (Point point : box_points(0, 0.5)) {
            point[0] += box;
            points.push_back(point);
        }
    }
    delotet::Plc plc(points);
    plc.add_triangles(corners);
    const delotet::Mesh mesh = delotet::tetrahedralize(plc);
    CHECK(mesh.regions().size() == 201);
    std::vector<Index> tets(points.size());
    mesh.locate(points, tets);
    for (Index tet : tets)
        CHECK(tet != delotet::invalid_index);
    CHECK(caught<delotet::Exception>([] { pierced().check(); }).status() == DELOTET_STATUS_SELF_INTERSECTION);
    return nullptr;
}

int main()
{
    pthread_attr_t attributes;
    pthread_t thread;
    CHECK(pthread_attr_init(&attributes) == 0);
    CHECK(pthread_attr_setstacksize(&attributes, 256 * 1024) == 0);
    CHECK(pthread_create(&thread, &attributes, work, nullptr) == 0);
    CHECK(pthread_join(thread, nullptr) == 0);
    pthread_attr_destroy(&attributes);
    return 0;
}
