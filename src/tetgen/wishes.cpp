// What is wanted of a mesh: switches as options of the engine.
#include "stages.hpp"

#include <algorithm>
#include <cmath>

namespace delotet_tetgen {

namespace {

/// The effort of optimisation for the level of O. The defaults (2 in TetGen 1.5, 3 in 1.6) are 1, as much as pays; what is asked for
/// beyond them is 2, and the upper levels are 3, which take about three and six times as long (src/doc/options.md).
std::uint32_t effort(const Call &call)
{
    const int level = call.switches.optlevel;
    if (level <= 0)
        return 0;
    return level <= 4 ? 1 : level <= 8 ? 2 : 3;
}

/// The smallest dihedral angle to work for beyond what the effort reaches by itself, which is about 20 degrees where the input allows it:
/// that of q if it is larger than 15. For an angle that is not reached the engine tries greater efforts from the start. That pays for angles
/// that a first attempt falls short of, not for needles of the input: with it q1.1/10Y takes 7.6 s instead of 0.5 s on the model anchor, where
/// the smallest angle is then 4.9 degrees instead of 0.09 (TetGen 1.5: 0.1 s, 0.006). The largest angle of o is no such wish: 120 degrees, which
/// some programs ask for, no mesh has everywhere, and trying took 31 s instead of 0.24 s on the model goathead.
double angle(const Call &call)
{
    const double angle = call.switches.quality ? call.switches.mindihedral : 0;
    return angle > 15 ? std::min(angle, 60.0) : 0;
}

} // namespace

double length_of_volume(double volume)
{
    return std::cbrt(volume * 6 * std::sqrt(2.0));
}

bool fills(const Call &call, bool bounded)
{
    const tetgenbehavior &switches = call.switches;
    return switches.quality || (switches.fixedvolume && switches.maxvolume > 0) || (switches.varvolume && bounded);
}

delotet::Options options_of(const Call &call, bool bounded, int relaxed)
{
    const tetgenbehavior &switches = call.switches;
    delotet::Options options;
    if (switches.steinerleft >= 0)
        options.steiner_limit(static_cast<std::uint64_t>(switches.steinerleft));
    if (call.log.verbose())
        options.on_log([&call](const char *message) { call.log.line("  %s", message); });
    if (!fills(call, bounded) || relaxed < 0)
        return options;
    if (switches.quality)
        options.quality(std::max(switches.minratio, 1.0) * std::pow(1.5, relaxed));
    if (switches.fixedvolume && switches.maxvolume > 0)
        options.max_volume(switches.maxvolume * std::pow(4.0, relaxed));
    else if (!switches.quality) // The bounds of regions and tetrahedra count once the mesh is filled: this one asks for nothing.
        options.max_volume(std::numeric_limits<double>::max());
    // q bounds shapes alone, so sizes may grow as fast as these allow; with 0.3, the engine's default, pqQ has 1.5 times as many points (22,775
    // on the model spot instead of 14,566; TetGen 1.5 has 18,534) and takes 1.7 times as long. Sizes that are given (m) grow as usual.
    if (!switches.metric)
        options.gradation(1);
    options.optimize(effort(call));
    if (effort(call) > 0)
        options.min_angle(angle(call));
    return options;
}

void set_background(const Call &call, delotet::Options &options)
{
    const tetgenio *background = call.bgmin;
    if (!call.switches.metric || !background || !background->pointmtrlist || background->numberofpointmtrs <= 0)
        return;
    if (background->numberoftetrahedra <= 0 || !background->tetrahedronlist || background->numberofcorners < 4 || !background->pointlist)
        call.log.fail(bad_input, "The background mesh has no tetrahedra.");
    const std::vector<delotet::Point> points = points_of(*background);
    std::vector<delotet::Tet> tets(static_cast<std::size_t>(background->numberoftetrahedra));
    const std::size_t corners = static_cast<std::size_t>(background->numberofcorners);
    for (std::size_t i = 0; i < tets.size(); i++)
        for (std::size_t k = 0; k < 4; k++)
            tets[i][k] = point_of(call, *background, background->tetrahedronlist[corners * i + k], "background tetrahedron", i + 1);
    delotet::MeshArrays arrays;
    arrays.points = points;
    arrays.tets = tets;
    const delotet::Mesh mesh = delotet::mesh_from_arrays(arrays);
    options.background(mesh, sizes_of(call, *background));
}

} // namespace delotet_tetgen
