// The Poisson equation with linear elements on our mesh: -Δu = f in the unit cube, u = 0 on its surface, with the manufactured
// solution u = sin(πx) sin(πy) sin(πz). The surface is refined three times; the error must fall with the square of the edge.
#include "lattice.hpp"

#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <cmath>
#include <cstdio>

static const double pi = 3.14159265358979323846;

static double solution(const delotet::Point &p)
{
    return std::sin(pi * p[0]) * std::sin(pi * p[1]) * std::sin(pi * p[2]);
}

/// Error of the finite element solution in the L2 norm.
static double solve(const delotet::Mesh &mesh)
{
    const auto points = mesh.points();
    // Free points get equation numbers; those of the boundary are known from its faces.
    std::vector<int> equation(points.size(), 0);
    for (const delotet::Subface &face : mesh.subfaces())
        for (const delotet::Index corner : face.corners)
            equation[corner] = -1;
    int count = 0;
    for (int &number : equation)
        if (number == 0)
            number = count++;

    // Quadrature of degree 2: four points of equal weight.
    const double near = 0.58541019662496852, far = 0.1381966011250105;
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd load = Eigen::VectorXd::Zero(count);
    for (const delotet::Tet &tet : mesh.tets()) {
        Eigen::Matrix4d vertices; // Rows: 1, x, y, z of a corner.
        for (int i = 0; i < 4; i++)
            vertices.row(i) << 1, points[tet[i]][0], points[tet[i]][1], points[tet[i]][2];
        const double volume = vertices.determinant() / 6;
        const Eigen::Matrix<double, 3, 4> gradients = vertices.inverse().bottomRows<3>();
        const Eigen::Matrix4d stiffness = volume * gradients.transpose() * gradients;
        for (int i = 0; i < 4; i++) {
            const int row = equation[tet[i]];
            if (row < 0)
                continue;
            for (int j = 0; j < 4; j++)
                if (equation[tet[j]] >= 0)
                    entries.emplace_back(row, equation[tet[j]], stiffness(i, j));
            for (int q = 0; q < 4; q++) {
                delotet::Point at{};
                for (int k = 0; k < 4; k++)
                    for (int axis = 0; axis < 3; axis++)
                        at[axis] += (k == q ? near : far) * points[tet[k]][axis];
                load[row] += volume / 4 * 3 * pi * pi * solution(at) * (i == q ? near : far);
            }
        }
    }
    Eigen::SparseMatrix<double> matrix(count, count);
    matrix.setFromTriplets(entries.begin(), entries.end());
    Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver;
    solver.setTolerance(1e-10);
    const Eigen::VectorXd u = solver.compute(matrix).solve(load);

    double sum = 0;
    for (const delotet::Tet &tet : mesh.tets()) {
        Eigen::Matrix4d vertices;
        for (int i = 0; i < 4; i++)
            vertices.row(i) << 1, points[tet[i]][0], points[tet[i]][1], points[tet[i]][2];
        for (int q = 0; q < 4; q++) {
            delotet::Point at{};
            double value = 0;
            for (int k = 0; k < 4; k++) {
                const double weight = k == q ? near : far;
                for (int axis = 0; axis < 3; axis++)
                    at[axis] += weight * points[tet[k]][axis];
                value += weight * (equation[tet[k]] < 0 ? 0 : u[equation[tet[k]]]);
            }
            sum += vertices.determinant() / 24 * std::pow(value - solution(at), 2);
        }
    }
    return std::sqrt(sum);
}

int main()
{
    double before = 0;
    bool good = true;
    for (int n = 4; n <= 32; n *= 2) {
        const delotet::Mesh mesh = delotet::tetrahedralize(lattice({n, n, n}, 1.0 / n));
        const double error = solve(mesh);
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
