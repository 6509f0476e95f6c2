// One Delaunay tetrahedralization by a peer: bench_cgal FILE, bench_tetgen FILE. The file holds coordinates as doubles. Prints
// processor seconds, wall seconds (both without reading) and the number of tetrahedra.
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <ctime>
#include <vector>

#ifdef PEER_CGAL
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

static std::size_t run(std::vector<double> &xyz, void (*start)(), void (*stop)())
{
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    std::vector<Kernel::Point_3> points;
    for (std::size_t i = 0; i + 2 < xyz.size(); i += 3)
        points.emplace_back(xyz[i], xyz[i + 1], xyz[i + 2]);
    std::vector<double>().swap(xyz);
    start();
    const CGAL::Delaunay_triangulation_3<Kernel> mesh(points.begin(), points.end());
    stop();
    return mesh.number_of_finite_cells();
}
#else
#include <tetgen.h>

static std::size_t run(std::vector<double> &xyz, void (*start)(), void (*stop)())
{
    tetgenio in, out;
    in.firstnumber = 0;
    in.numberofpoints = static_cast<int>(xyz.size() / 3);
    in.pointlist = xyz.data();
    tetgenbehavior behavior;
    char switches[] = "Q";
    behavior.parse_commandline(switches);
    start();
    tetrahedralize(&behavior, &in, &out);
    stop();
    in.pointlist = nullptr; // The vector frees it.
    return static_cast<std::size_t>(out.numberoftetrahedra);
}
#endif

static double processor, wall;

static double now()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

int main(int count, char **words)
{
    std::FILE *file = count == 2 ? std::fopen(words[1], "rb") : nullptr;
    if (!file)
        return 2;
    std::fseek(file, 0, SEEK_END);
    std::vector<double> xyz(static_cast<std::size_t>(std::ftell(file)) / sizeof(double));
    std::rewind(file);
    if (std::fread(xyz.data(), sizeof(double), xyz.size(), file) != xyz.size())
        return 2;
    std::fclose(file);
    const std::size_t tets = run(
        xyz, [] { wall = now(); processor = static_cast<double>(std::clock()); },
        [] {
            wall = now() - wall;
            processor = (static_cast<double>(std::clock()) - processor) / CLOCKS_PER_SEC;
        });
    std::printf("%.6f %.6f %zu\n", processor, wall, tets);
    return 0;
}
