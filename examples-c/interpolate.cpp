// A field from one mesh to another: locate the points of the second mesh in the first, and weigh by barycentric coordinates.
#include "lattice.hpp"

#include <cmath>
#include <cstdio>
#include <functional>

using Field = std::function<double(const delotet::Point &)>;

/// Largest error at the points of `to` of a field that is known at the points of `from`.
static double error(const delotet::Mesh &from, const delotet::Mesh &to, const Field &field)
{
    std::vector<double> values;
    for (const delotet::Point &point : from.points())
        values.push_back(field(point));
    std::vector<delotet::Index> tets(to.points().size());
    std::vector<std::array<double, 4>> weights(to.points().size());
    from.locate(to.points(), tets, weights);
    double largest = 0;
    for (std::size_t i = 0; i < tets.size(); i++) {
        if (tets[i] == delotet::invalid_index)
            return INFINITY; // Outside: both meshes fill the same box, so this must not happen.
        double value = 0;
        for (std::size_t k = 0; k < 4; k++)
            value += weights[i][k] * values[from.tets()[tets[i]][k]];
        largest = std::fmax(largest, std::fabs(value - field(to.points()[i])));
    }
    return largest;
}

int main()
{
    const Field linear = [](const delotet::Point &p) { return 1 + 2 * p[0] - 3 * p[1] + 0.5 * p[2]; };
    const Field quadratic = [](const delotet::Point &p) { return p[0] * p[0] + p[1] * p[2]; };
    const delotet::Mesh target = delotet::tetrahedralize(lattice({7, 7, 7}, 1.0 / 7));
    const delotet::Mesh coarse = delotet::tetrahedralize(lattice({4, 4, 4}, 1.0 / 4));
    const delotet::Mesh fine = delotet::tetrahedralize(lattice({8, 8, 8}, 1.0 / 8));
    // 7 · (1/7) is exactly 1, and so are 4 · (1/4) and 8 · (1/8): the boxes agree to the last bit.
    const double exact = error(coarse, target, linear);
    const double first = error(coarse, target, quadratic), second = error(fine, target, quadratic);
    std::printf("errors: linear %.1e, quadratic %.2e and %.2e\n", exact, first, second);
    if (exact < 1e-13)
        std::printf("linear field: exact to rounding\n");
    if (first / second > 3 && first / second < 6)
        std::printf("quadratic field: error falls with the square\n");
}
