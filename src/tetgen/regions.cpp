// The attributes of tetrahedra as TetGen numbers regions (A).
#include "stages.hpp"

#include <algorithm>

namespace delotet_tetgen {

/// Attributes of the tetrahedra by region: those of the seeds, numbers of their own for regions without one, and -1 for what c keeps of the
/// outside and of holes.
std::vector<std::vector<double>> numbered_regions(const Call &call, const Domain &domain, const delotet::Mesh &mesh)
{
    std::vector<std::vector<double>> rows(mesh.regions().size());
    if (!call.switches.regionattrib && !call.switches.convex)
        return rows;
    std::vector<bool> outside(rows.size());
    if (call.switches.convex) { // What a face of the hull that is no piece of a facet bounds is outside.
        for (const delotet::Face &face : mesh.faces())
            if (face.tets[1] == delotet::invalid_index && face.subface == delotet::invalid_index)
                outside[mesh.tet_regions()[face.tets[0]]] = true;
    }
    int next = 1;
    std::vector<Index> bare;
    for (std::size_t i = 0; i < rows.size(); i++) {
        const Index seed = mesh.regions()[i].seed;
        if (seed != delotet::invalid_index && !domain.seeds[seed].hole) {
            rows[i] = {static_cast<double>(domain.seeds[seed].attribute)};
            next = std::max(next, domain.seeds[seed].attribute == std::numeric_limits<int>::max() ? next : domain.seeds[seed].attribute + 1);
        } else if (outside[i] || seed != delotet::invalid_index) {
            rows[i] = {-1};
        } else {
            bare.push_back(static_cast<Index>(i));
        }
    }
    // Those without a seed are numbered from the outside in, as TetGen meets them.
    std::vector<std::vector<Index>> beside(rows.size());
    std::vector<Index> order;
    std::vector<bool> met(rows.size());
    for (const delotet::Subface &face : mesh.subfaces()) {
        const Index region = mesh.tet_regions()[face.tets[0]];
        if (face.tets[1] == delotet::invalid_index) {
            if (!met[region])
                order.push_back(region);
            met[region] = true;
        } else if (const Index other = mesh.tet_regions()[face.tets[1]]; other != region) {
            beside[region].push_back(other);
            beside[other].push_back(region);
        }
    }
    for (std::size_t i = 0; i < order.size(); i++)
        for (const Index other : beside[order[i]])
            if (!met[other]) {
                met[other] = true;
                order.push_back(other);
            }
    for (const std::vector<Index> &list : {order, bare})
        for (const Index region : list)
            if (rows[region].empty())
                rows[region] = {static_cast<double>(next++)};
    return rows;
}

} // namespace delotet_tetgen
