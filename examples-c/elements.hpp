// Linear elements on our meshes, for the examples that solve -div(k grad u) = f: assembly, solution by conjugate gradients, errors.
#ifndef EXAMPLES_ELEMENTS_HPP
#define EXAMPLES_ELEMENTS_HPP
#include <delotet/delotet.hpp>

#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <cmath>
#include <limits>
#include <vector>

/// A point that is not fixed.
static const double unknown = std::numeric_limits<double>::quiet_NaN();

/// A tetrahedron and the gradients of its four linear functions.
struct Element {
    Element(const delotet::Mesh &mesh, const delotet::Tet &corners)
    {
        for (int i = 0; i < 4; i++) {
            at[i] = mesh.points()[corners[i]];
            vertices.row(i) << 1, at[i][0], at[i][1], at[i][2];
        }
        volume = vertices.determinant() / 6;
        gradients = vertices.inverse().bottomRows<3>();
    }
    /// Weight of corner k in point q of the quadrature of degree 2: four points of equal weight.
    static double weight(int q, int k) { return k == q ? 0.58541019662496852 : 0.1381966011250105; }
    delotet::Point point(int q) const
    {
        delotet::Point sum{};
        for (int k = 0; k < 4; k++)
            for (int axis = 0; axis < 3; axis++)
                sum[axis] += weight(q, k) * at[k][axis];
        return sum;
    }
    /// The gradient of a function given at the points of the mesh.
    Eigen::Vector3d gradient(const std::vector<double> &u, const delotet::Tet &corners) const
    {
        return gradients * Eigen::Vector4d(u[corners[0]], u[corners[1]], u[corners[2]], u[corners[3]]);
    }

    delotet::Point at[4];
    Eigen::Matrix4d vertices; // Rows: 1, x, y, z of a corner.
    double volume;
    Eigen::Matrix<double, 3, 4> gradients;
};

/// The solution at the points of a mesh.
struct Solution {
    std::vector<double> u;
    bool found = false;
    int iterations = 0;
};

/// Solves with values `fixed` at some points, `unknown` at the others. `conductivity` has a tetrahedron's index, `source` a place.
template <class Conductivity, class Source>
Solution solve(const delotet::Mesh &mesh, std::vector<double> fixed, Conductivity conductivity, Source source,
               double tolerance)
{
    const auto tets = mesh.tets();
    std::vector<int> equation(fixed.size(), -1);
    int count = 0;
    for (std::size_t i = 0; i < fixed.size(); i++)
        if (std::isnan(fixed[i]))
            equation[i] = count++;
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd load = Eigen::VectorXd::Zero(count);
    for (std::size_t t = 0; t < tets.size(); t++) {
        const delotet::Tet &tet = tets[t];
        const Element element(mesh, tet);
        const Eigen::Matrix4d stiffness =
            conductivity(t) * element.volume * element.gradients.transpose() * element.gradients;
        for (int i = 0; i < 4; i++) {
            const int row = equation[tet[i]];
            if (row < 0)
                continue;
            for (int j = 0; j < 4; j++)
                if (equation[tet[j]] >= 0)
                    entries.emplace_back(row, equation[tet[j]], stiffness(i, j));
                else
                    load[row] -= stiffness(i, j) * fixed[tet[j]];
            for (int q = 0; q < 4; q++)
                load[row] += element.volume / 4 * source(element.point(q)) * Element::weight(q, i);
        }
    }
    Eigen::SparseMatrix<double> matrix(count, count);
    matrix.setFromTriplets(entries.begin(), entries.end());
    Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver;
    solver.setTolerance(tolerance);
    const Eigen::VectorXd x = solver.compute(matrix).solve(load);
    for (std::size_t i = 0; i < fixed.size(); i++)
        if (equation[i] >= 0)
            fixed[i] = x[equation[i]];
    return {std::move(fixed), solver.info() == Eigen::Success, int(solver.iterations())};
}

/// The L2 norm of the difference from a function.
template <class Exact> double l2_error(const delotet::Mesh &mesh, const std::vector<double> &u, Exact exact)
{
    double sum = 0;
    for (const delotet::Tet &tet : mesh.tets()) {
        const Element element(mesh, tet);
        for (int q = 0; q < 4; q++) {
            double value = 0;
            for (int k = 0; k < 4; k++)
                value += Element::weight(q, k) * u[tet[k]];
            sum += element.volume / 4 * std::pow(value - exact(element.point(q)), 2);
        }
    }
    return std::sqrt(sum);
}

/// The L2 norm of the difference of gradients.
template <class Gradient>
double energy_error(const delotet::Mesh &mesh, const std::vector<double> &u, Gradient gradient)
{
    double sum = 0;
    for (const delotet::Tet &tet : mesh.tets()) {
        const Element element(mesh, tet);
        for (int q = 0; q < 4; q++)
            sum += element.volume / 4 * (element.gradient(u, tet) - gradient(element.point(q))).squaredNorm();
    }
    return std::sqrt(sum);
}
#endif
