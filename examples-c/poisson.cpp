// The Poisson equation with linear elements on our mesh: -Δu = f in the unit cube, u = 0 on its surface, with the manufactured
// solution u = sin(πx) sin(πy) sin(πz). The surface is refined three times; the error must fall with the square of the edge.
#include "elements.hpp"
#include "lattice.hpp"

#include <cstdio>

static const double pi = 3.14159265358979323846;

static double solution(const delotet::Point &p)
{
    return std::sin(pi * p[0]) * std::sin(pi * p[1]) * std::sin(pi * p[2]);
}

/// Error of the finite element solution in the L2 norm.
static double error_on(const delotet::Mesh &mesh)
{
    std::vector<double> fixed(mesh.points().size(), unknown);
    for (const delotet::Subface &face : mesh.subfaces())
        for (const delotet::Index corner : face.corners)
            fixed[corner] = 0;
    const auto source = [](const delotet::Point &p) { return 3 * pi * pi * solution(p); };
    return l2_error(mesh, solve(mesh, fixed, [](std::size_t) { return 1.0; }, source, 1e-10).u, solution);
}

int main()
{
    double before = 0;
    bool good = true;
    for (int n = 4; n <= 32; n *= 2) {
        const delotet::Mesh mesh = delotet::tetrahedralize(lattice({n, n, n}, 1.0 / n));
        const double error = error_on(mesh);
        std::printf("edge 1/%-2d  %7zu tetrahedra  error %.3e", n, mesh.tets().size(), error);
        if (before > 0) {
            const double rate = std::log2(before / error);
            std::printf("  rate %.2f", rate);
            good = good && rate > 1.8 && rate < 2.3;
        }
        std::printf("\n");
        before = error;
    }
    std::printf(good ? "the error falls with the square of the edge length\n" : "the rate is wrong\n");
    return !good;
}
