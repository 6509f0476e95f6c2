// Volumes, for the examples that print or need them.
#ifndef EXAMPLES_VOLUME_HPP
#define EXAMPLES_VOLUME_HPP
#include <delotet/delotet.hpp>

inline double volume(const delotet::Point &a, const delotet::Point &b, const delotet::Point &c, const delotet::Point &d)
{
    double e[3][3];
    for (std::size_t axis = 0; axis < 3; axis++) {
        e[0][axis] = b[axis] - a[axis];
        e[1][axis] = c[axis] - a[axis];
        e[2][axis] = d[axis] - a[axis];
    }
    return (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
            e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) / 6;
}

inline double volume(const delotet::Mesh &mesh)
{
    const auto p = mesh.points();
    double sum = 0;
    for (const delotet::Tet &tet : mesh.tets())
        sum += volume(p[tet[0]], p[tet[1]], p[tet[2]], p[tet[3]]);
    return sum;
}
#endif
