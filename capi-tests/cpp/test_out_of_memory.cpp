// When memory is short, every call returns DELOTET_STATUS_OUT_OF_MEMORY, wherever the memory runs out; nothing aborts. Each limit runs in a
// child process, from far too little memory to plenty.
#include "test.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

static int run(const std::vector<Point> &points, rlim_t megabytes)
{
    const rlimit limit = {megabytes << 20, megabytes << 20};
    if (setrlimit(RLIMIT_AS, &limit) != 0)
        return 1;
    delotet::Error error;
    delotet::Plc plc;
    delotet::Mesh mesh;
    delotet::Records<delotet::Edge> edges;
    delotet::SecondOrder second;
    std::vector<Index> corners = box_corners();
    if (delotet::Plc::create(points, plc, error) != DELOTET_STATUS_OK ||
        plc.add_triangles(corners, {}, error) != DELOTET_STATUS_OK ||
        delotet::tetrahedralize(plc, {}, mesh, error) != DELOTET_STATUS_OK ||
        mesh.edges(edges, error) != DELOTET_STATUS_OK ||
        mesh.second_order(delotet::NodeOrder::vtk, second, error) != DELOTET_STATUS_OK)
        return error.status();
    return 0;
}

int main()
{
    std::vector<Point> points = box_points(0, 1);
    for (const Point &point : random_points(8000))
        points.push_back(point);
    int short_of_memory = 0, meshed = 0;
    for (rlim_t megabytes = 8; megabytes <= 80; megabytes += 2) {
        const pid_t child = fork();
        if (child == 0)
            _exit(run(points, megabytes));
        int status = 0;
        CHECK(waitpid(child, &status, 0) == child);
        CHECK(WIFEXITED(status));
        short_of_memory += WEXITSTATUS(status) == DELOTET_STATUS_OUT_OF_MEMORY;
        meshed += WEXITSTATUS(status) == 0;
        CHECK(WEXITSTATUS(status) == 0 || WEXITSTATUS(status) == DELOTET_STATUS_OUT_OF_MEMORY);
    }
    CHECK(short_of_memory > 0 && meshed > 0);
    return 0;
}
