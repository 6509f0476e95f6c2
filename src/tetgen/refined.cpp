// A run on a given mesh (r).
#include "stages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace delotet_tetgen {

namespace {

/// Rows of attributes by region of a mesh whose attributes are positions of rows.
std::vector<std::vector<double>> given_rows(const Given &given, const delotet::Mesh &mesh)
{
    std::vector<std::vector<double>> rows(mesh.regions().size());
    if (!given.rows.empty())
        for (std::size_t i = 0; i < rows.size(); i++)
            rows[i] = given.rows[static_cast<std::size_t>(mesh.regions()[i].attribute)];
    return rows;
}

/// The lengths at the points of a mesh from those in its tetrahedra: the smallest around each.
std::vector<double> at_points(const delotet::Mesh &mesh, const std::vector<double> &lengths)
{
    std::vector<double> sizes(mesh.points().size(), no_wish);
    for (std::size_t i = 0; i < lengths.size(); i++)
        for (const Index corner : mesh.tets()[i])
            sizes[corner] = std::min(sizes[corner], lengths[i]);
    return sizes;
}

std::vector<double> lengths_of(const Given &given)
{
    std::vector<double> lengths;
    for (const double volume : given.volumes)
        lengths.push_back(volume < no_wish ? length_of_volume(volume) : no_wish);
    return lengths;
}

/// Shortens the lengths in the given tetrahedra where a mesh is above their bounds on volumes. Returns how many of its tetrahedra are.
std::size_t shorten(const Given &given, const delotet::Mesh &mesh, std::vector<double> &lengths)
{
    const std::size_t count = given.volumes.empty() ? 0 : mesh.tets().size();
    std::vector<delotet::Point> middles(count);
    for (std::size_t i = 0; i < count; i++)
        for (const Index corner : mesh.tets()[i])
            for (std::size_t axis = 0; axis < 3; axis++)
                middles[i][axis] += mesh.points()[corner][axis] / 4;
    std::vector<Index> places(count);
    given.mesh.locate(middles, places, {});
    std::vector<double> factors(lengths.size(), 1);
    std::size_t found = 0;
    const delotet::Records<delotet::TetQuality> quality = mesh.quality();
    for (std::size_t i = 0; i < count; i++) {
        if (places[i] == delotet::invalid_index || quality[i].volume <= given.volumes[places[i]])
            continue;
        found++;
        factors[places[i]] = std::min(factors[places[i]], std::cbrt(given.volumes[places[i]] / quality[i].volume));
    }
    for (std::size_t i = 0; i < lengths.size(); i++)
        if (factors[i] < 1)
            lengths[i] *= std::clamp(0.95 * factors[i], 0.5, 0.95);
    return found;
}

/// Makes a mesh with lengths in the given tetrahedra, again and again until their bounds on volumes hold everywhere. The engine has
/// bounds for regions, not for tetrahedra; those come from lengths, which bound volumes only on the average. Two or three rounds do, and
/// where a surface that stays is in the way more of them help nothing.
template <class Make> delotet::Mesh within_volumes(const Given &given, Make &&make)
{
    std::vector<double> lengths = lengths_of(given);
    std::size_t before = std::numeric_limits<std::size_t>::max();
    for (int round = 0;; round++) {
        delotet::Mesh mesh = make(lengths);
        const std::size_t found = given.volumes.empty() ? 0 : shorten(given, mesh, lengths);
        if (found == 0 || round == 7 || found > before - before / 10)
            return mesh;
        before = found;
    }
}

/// A given mesh with a boundary that may be refined: through its PLC.
Result refined_with_boundary(const Call &call, const Given &given)
{
    std::vector<delotet::Point> voids;
    for (;;) {
        const Domain domain = domain_of(call, given, voids);
        Result result;
        result.mesh = within_volumes(given, [&](const std::vector<double> &lengths) {
            Background background;
            if (!lengths.empty())
                background = {&given.mesh, at_points(given.mesh, lengths)};
            return mesh_of(call, domain, !lengths.empty(), background);
        });
        // What no part of the given mesh is in is a hole of it.
        const std::size_t known = voids.size();
        const delotet::Records<delotet::TetQuality> quality = result.mesh.quality();
        std::vector<Index> largest(result.mesh.regions().size(), delotet::invalid_index);
        for (std::size_t i = 0; i < result.mesh.tets().size(); i++) {
            const Index region = result.mesh.tet_regions()[i];
            if (result.mesh.regions()[region].seed == delotet::invalid_index &&
                (largest[region] == delotet::invalid_index || quality[i].volume > quality[largest[region]].volume))
                largest[region] = static_cast<Index>(i);
        }
        for (const Index tet : largest) {
            if (tet == delotet::invalid_index)
                continue;
            delotet::Point middle = {};
            for (const Index corner : result.mesh.tets()[tet])
                for (std::size_t axis = 0; axis < 3; axis++)
                    middle[axis] += result.mesh.points()[corner][axis] / 4;
            voids.push_back(middle);
        }
        if (voids.size() > known)
            continue;
        result.rows = given_rows(given, result.mesh);
        keep_markers(call, domain, result);
        return result;
    }
}

/// What points carry with them at the points of a refined mesh: linear in the tetrahedra of the given one.
std::vector<double> interpolated(const Call &call, const delotet::Mesh &given, const delotet::Mesh &mesh)
{
    PointRows rows = point_rows(call);
    const std::size_t width = rows.width(), known = call.input_points(), count = mesh.points().size();
    if (width == 0 || count <= known)
        return rows.data;
    const delotet::Span<const delotet::Point> added(mesh.points().data() + known, count - known);
    std::vector<Index> tets(added.size());
    std::vector<std::array<double, 4>> weights(added.size());
    given.locate(added, tets, weights);
    rows.data.resize(width * count);
    for (std::size_t i = 0; i < added.size(); i++)
        for (std::size_t corner = 0; corner < 4 && tets[i] != delotet::invalid_index; corner++)
            for (std::size_t k = 0; k < width; k++)
                rows.data[width * (known + i) + k] += weights[i][corner] * rows.data[width * given.tets()[tets[i]][corner] + k];
    return rows.data;
}

/// A given mesh whose faces stay.
Result refined_inside(const Call &call, Given &given)
{
    Result result;
    const bool bounded = !given.volumes.empty();
    const std::vector<double> sizes = sizes_of(call, call.in);
    if (fills(call, bounded)) {
        delotet::Options options = options_of(call, bounded);
        set_background(call, options);
        result.mesh = within_volumes(given, [&](const std::vector<double> &lengths) {
            delotet::MeshSizes wanted;
            if (!lengths.empty())
                wanted.tets(lengths);
            if (!sizes.empty())
                wanted.points(sizes);
            return delotet::refine(given.mesh, wanted, options);
        });
        result.point_rows = interpolated(call, given.mesh, result.mesh);
    } else {
        result.mesh = std::move(given.mesh);
        result.point_rows = point_rows(call).data;
    }
    result.rows = given_rows(given, result.mesh);
    result.segment_markers = given.edge_markers;
    return result;
}

} // namespace

Result from_mesh(const Call &call)
{
    Given given = given_mesh(call);
    const tetgenbehavior &switches = call.switches;
    const bool asked = call.in.tetunsuitable && (switches.quality || switches.fixedvolume || switches.varvolume);
    const bool changes = fills(call, !given.volumes.empty()) || call.added_points() > 0 || asked;
    Result result;
    if (!changes || (switches.nobisect && call.added_points() == 0)) {
        result = refined_inside(call, given);
    } else {
        try {
            result = refined_with_boundary(call, given);
        } catch (const delotet::Exception &failure) {
            if (memory_ran_out(failure) || call.added_points() > 0)
                throw;
            call.log.line("Warning:  The boundary is kept: %s", failure.what());
            result = refined_inside(call, given);
        }
    }
    result.surface = true;
    return result;
}

} // namespace delotet_tetgen
