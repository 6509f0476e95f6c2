// TetGen 1.5 by its library, in a child process whose end is reported as the outcome.
#include "peers.hpp"

#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <sys/wait.h>
#include <tetgen.h>
#include <unistd.h>

template <class T> static void put(std::FILE *file, const std::vector<T> &list)
{
    const std::size_t count = list.size();
    std::fwrite(&count, sizeof count, 1, file);
    std::fwrite(list.data(), sizeof(T), count, file);
}

template <class T> static bool get(std::FILE *file, std::vector<T> &list)
{
    std::size_t count = 0;
    if (std::fread(&count, sizeof count, 1, file) != 1)
        return false;
    list.resize(count);
    return std::fread(list.data(), sizeof(T), count, file) == count;
}

/// The child: runs TetGen and writes its result. With `weights` it makes the diagram as well.
static void child(const std::vector<Point> &points, const std::vector<Triangle> &triangles, bool preserved,
                  const std::vector<double> *weights, std::FILE *file)
{
    tetgenio in, out;
    in.firstnumber = 0;
    in.numberofpoints = static_cast<int>(points.size());
    in.pointlist = new REAL[3 * points.size()];
    std::memcpy(in.pointlist, points.data(), sizeof(Point) * points.size());
    if (!triangles.empty()) {
        in.numberoffacets = static_cast<int>(triangles.size());
        in.facetlist = new tetgenio::facet[triangles.size()];
        for (std::size_t i = 0; i < triangles.size(); i++) {
            tetgenio::facet &facet = in.facetlist[i];
            tetgenio::init(&facet);
            facet.numberofpolygons = 1;
            facet.polygonlist = new tetgenio::polygon[1];
            tetgenio::init(facet.polygonlist);
            facet.polygonlist->numberofvertices = 3;
            facet.polygonlist->vertexlist = new int[3];
            for (int k = 0; k < 3; k++)
                facet.polygonlist->vertexlist[k] = static_cast<int>(triangles[i][static_cast<std::size_t>(k)]);
        }
    }
    const bool weighted = weights && !weights->empty();
    if (weighted) {
        in.numberofpointattributes = 1;
        in.pointattributelist = new REAL[points.size()];
        std::memcpy(in.pointattributelist, weights->data(), sizeof(REAL) * points.size());
    }
    tetgenbehavior behavior;
    char switches[] = "pQ", keep[] = "pYQ", none[] = "Q", diagram[] = "vQ", power[] = "wvQ";
    behavior.parse_commandline(weighted            ? power
                               : weights           ? diagram
                               : triangles.empty() ? none
                               : preserved         ? keep
                                                   : switches);
    const Stopwatch watch;
    tetrahedralize(&behavior, &in, &out);
    std::vector<double> seconds(1, watch.seconds());
    std::vector<Point> vertices(static_cast<std::size_t>(out.numberofpoints));
    std::memcpy(vertices.data(), out.pointlist, sizeof(Point) * vertices.size());
    std::vector<Tet> tets(static_cast<std::size_t>(out.numberoftetrahedra));
    for (std::size_t i = 0; i < tets.size(); i++)
        for (std::size_t k = 0; k < 4; k++)
            tets[i][k] = static_cast<std::uint32_t>(out.tetrahedronlist[4 * i + k]);
    std::vector<Triangle> faces(static_cast<std::size_t>(out.numberoftrifaces));
    for (std::size_t i = 0; i < faces.size(); i++)
        for (std::size_t k = 0; k < 3; k++)
            faces[i][k] = static_cast<std::uint32_t>(out.trifacelist[3 * i + k]);
    std::vector<Point> centers(weights ? static_cast<std::size_t>(out.numberofvpoints) : 0);
    if (!centers.empty())
        std::memcpy(centers.data(), out.vpointlist, sizeof(Point) * centers.size());
    put(file, seconds);
    put(file, vertices);
    put(file, tets);
    put(file, faces);
    put(file, centers);
}

static Result run(const std::vector<Point> &points, const std::vector<Triangle> &triangles, unsigned limit_seconds,
                  bool preserved, const std::vector<double> *weights)
{
    Result result;
    std::FILE *file = std::tmpfile();
    if (!file) {
        result.outcome = "no temporary file";
        return result;
    }
    std::fflush(nullptr);
    const pid_t pid = fork();
    if (pid == 0) {
        alarm(limit_seconds);
        const int nowhere = open("/dev/null", O_WRONLY);
        dup2(nowhere, 1);
        dup2(nowhere, 2);
        try {
            child(points, triangles, preserved, weights, file);
        } catch (...) { // It throws ints.
            _exit(3);
        }
        std::fflush(file);
        _exit(0);
    }
    int status = 0;
    waitpid(pid, &status, 0);
    if (WIFSIGNALED(status))
        result.outcome = WTERMSIG(status) == SIGALRM ? "time" : WTERMSIG(status) == SIGSEGV ? "segfault" : "abort";
    else if (WEXITSTATUS(status) != 0)
        result.outcome = "error";
    std::rewind(file);
    std::vector<double> seconds;
    if (result.ok() && get(file, seconds) && get(file, result.points) && get(file, result.tets) &&
        get(file, result.constraints) && get(file, result.centers))
        result.seconds = seconds[0];
    else if (result.ok())
        result.outcome = "nothing";
    std::fclose(file);
    return result;
}

Result tetgen(const std::vector<Point> &points, const std::vector<Triangle> &triangles, unsigned limit_seconds,
              bool preserved)
{
    return run(points, triangles, limit_seconds, preserved, nullptr);
}

Result tetgen_diagram(const std::vector<Point> &points, const std::vector<double> &weights, unsigned limit_seconds)
{
    return run(points, {}, limit_seconds, false, &weights);
}
