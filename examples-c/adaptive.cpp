// An adaptive loop: solve, estimate, refine. The Poisson equation in the unit cube, whose solution is a narrow peak inside. After each
// solution its second derivatives are recovered, sizes that spread the error evenly follow from them, and delotet::refine makes the next
// mesh. The surface stays coarse: nothing happens there. The error must fall at the best order that linear elements allow: in the energy
// norm with the number of points to the power -1/3, in the L2 norm to the power -2/3: adaptive [<mesh.ele> <values.txt>].
#include "elements.hpp"
#include "lattice.hpp"
#include "values.hpp"

#include <algorithm>
#include <cstdio>

static const double width = 0.08;
static const Eigen::Vector3d centre(0.4, 0.5, 0.55);

static Eigen::Vector3d from_centre(const delotet::Point &p)
{
    return Eigen::Vector3d(p[0], p[1], p[2]) - centre;
}

static double solution(const delotet::Point &p)
{
    return std::exp(-from_centre(p).squaredNorm() / (2 * width * width));
}

static Eigen::Vector3d gradient(const delotet::Point &p)
{
    return -solution(p) / (width * width) * from_centre(p);
}

static double source(const delotet::Point &p)
{
    const double s2 = width * width;
    return solution(p) * (3 / s2 - from_centre(p).squaredNorm() / (s2 * s2));
}

/// The cube's surface, without the points of the lattice inside.
static delotet::Plc cube(int n)
{
    const delotet::Plc full = lattice({n, n, n}, 1.0 / n);
    delotet::Plc surface(full.points());
    for (const delotet::Triangle &corners : full.triangles())
        surface.add_triangles(std::vector<delotet::Index>(corners.begin(), corners.end()));
    return surface;
}

/// For each point the mean over its tetrahedra of rows that are constant in each, weighted by volume.
static Eigen::MatrixXd averaged(const delotet::Mesh &mesh, const Eigen::MatrixXd &rows)
{
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(mesh.points().size()), rows.cols());
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(sums.rows());
    for (Eigen::Index t = 0; t < rows.rows(); t++) {
        const delotet::Tet &tet = mesh.tets()[static_cast<std::size_t>(t)];
        const double volume = Element(mesh, tet).volume;
        for (const delotet::Index v : tet) {
            sums.row(v) += volume * rows.row(t);
            weights[v] += volume;
        }
    }
    for (Eigen::Index v = 0; v < sums.rows(); v++)
        sums.row(v) /= std::max(weights[v], 1e-300);
    return sums;
}

/// The size of the second derivatives at each point: gradients of the averaged gradients.
static Eigen::VectorXd curvature(const delotet::Mesh &mesh, const std::vector<double> &u)
{
    const auto tets = mesh.tets();
    Eigen::MatrixXd first(tets.size(), 3), second(tets.size(), 1);
    for (std::size_t t = 0; t < tets.size(); t++)
        first.row(static_cast<Eigen::Index>(t)) = Element(mesh, tets[t]).gradient(u, tets[t]);
    const Eigen::MatrixXd at_points = averaged(mesh, first);
    for (std::size_t t = 0; t < tets.size(); t++) {
        Eigen::Matrix<double, 4, 3> corners;
        for (int i = 0; i < 4; i++)
            corners.row(i) = at_points.row(tets[t][i]);
        second(static_cast<Eigen::Index>(t), 0) = (Element(mesh, tets[t]).gradients * corners).norm();
    }
    return averaged(mesh, second);
}

/// Edge lengths for so many points: the square of the error h |D2 u| over a volume, for 1 / h^3 points in it, is least for h ~ |D2 u|^(-2/5).
static std::vector<double> lengths(const delotet::Mesh &mesh, const std::vector<double> &u, double points)
{
    const Eigen::VectorXd second = curvature(mesh, u);
    const double least = 1e-3 * second.maxCoeff();
    std::vector<double> h(mesh.points().size());
    for (std::size_t i = 0; i < h.size(); i++)
        h[i] = std::pow(std::max(second[static_cast<Eigen::Index>(i)], least), -0.4);
    double wanted = 0;
    for (const delotet::Tet &tet : mesh.tets())
        for (const delotet::Index v : tet)
            wanted += Element(mesh, tet).volume / 4 * std::sqrt(2.0) / (h[v] * h[v] * h[v]);
    for (double &length : h)
        length *= std::cbrt(wanted / points);
    return h;
}

int main(int argc, char **argv)
{
    const delotet::Options options = delotet::Options().mode(delotet::Mode::preserve).quality(2).optimize(1);
    delotet::Mesh mesh = delotet::tetrahedralize(cube(5), options);
    const int steps = 9, known = 5; // The first meshes are too coarse to know the peak.
    double before[3] = {0, 0, 0};
    bool good = true;
    for (int step = 1; step <= steps; step++) {
        const auto points = mesh.points();
        std::vector<double> fixed(points.size(), unknown);
        for (const delotet::Subface &face : mesh.subfaces())
            for (const delotet::Index corner : face.corners)
                fixed[corner] = solution(points[corner]);
        const Solution found = solve(mesh, fixed, [](std::size_t) { return 1.0; }, source, 1e-10);
        const double now[3] = {double(points.size()), energy_error(mesh, found.u, gradient),
                               l2_error(mesh, found.u, solution)};
        std::printf("step %d  %6.0f points  error in energy %.3e, in L2 %.3e", step, now[0], now[1], now[2]);
        if (step > known) {
            const double more = std::log(now[0] / before[0]);
            const double rates[] = {std::log(before[1] / now[1]) / more, std::log(before[2] / now[2]) / more};
            std::printf("  orders %.2f %.2f", rates[0], rates[1]);
            good = good && std::fabs(rates[0] - 1.0 / 3) < 0.1 && std::fabs(rates[1] - 2.0 / 3) < 0.2;
        } else if (step == known) {
            std::copy(now, now + 3, before);
        }
        std::printf("\n");
        good = good && found.found;
        if (step == known && argc > 2) {
            mesh.write(delotet::Plc(std::vector<delotet::Point>()), argv[1]);
            write_values(argv[2], found.u);
        }
        if (step < steps)
            mesh = delotet::refine(mesh, delotet::MeshSizes().points(lengths(mesh, found.u, 3 * now[0])), options);
    }
    std::printf(good ? "the error falls at its order\n" : "the order is wrong\n");
    return !good;
}
