// A run: what the switches ask for, by mode, with what TetGen passes over left out of the input.
#include "stages.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace delotet_tetgen {

namespace {

using delotet::Exception;

/// What is thrown for a status of the engine.
Thrown thrown_for(const Call &call, const Exception &failure)
{
    if (failure.status() == DELOTET_STATUS_ROUNDING && call.switches.nobisect > 1)
        return steiner_on_surface;
    if (memory_ran_out(failure))
        return out_of_memory;
    switch (failure.status()) {
    case DELOTET_STATUS_SELF_INTERSECTION:
    case DELOTET_STATUS_DEGENERATE_FACET:
    case DELOTET_STATUS_NON_PLANAR_FACET:
        return self_intersection;
    case DELOTET_STATUS_ROUNDING: {
        const delotet::Records<delotet::Defect> defects = failure.defects();
        const bool facets = !defects.empty() && defects[0].first_element == DELOTET_ELEMENT_FACET &&
                            defects[0].second_element == DELOTET_ELEMENT_FACET;
        return facets ? close_facets : small_feature;
    }
    case DELOTET_STATUS_INTERNAL:
    case DELOTET_STATUS_CANCELLED:
        return internal_error;
    default:
        return bad_input;
    }
}

/// Leaves out of the next attempt what TetGen passes over with a warning: seeds outside and on facets, facets without area and those given
/// twice. False if the failure has other reasons.
bool pass_over(const Call &call, const Exception &failure, const Domain &domain, LeftOut &left_out)
{
    const LeftOut before = left_out;
    bool found = false;
    for (const delotet::Defect &defect : failure.defects()) {
        switch (defect.kind) {
        case DELOTET_DEFECT_KIND_SEED_OUTSIDE:
        case DELOTET_DEFECT_KIND_SEED_ON_FACET: {
            const bool region = defect.first_element == DELOTET_ELEMENT_REGION;
            const Seed *seed = region && defect.first < domain.seeds.size() ? &domain.seeds[defect.first] : nullptr;
            if (!seed && (region || defect.first >= domain.holes.size()))
                return false;
            const bool hole = !region || seed->hole;
            const std::size_t origin = seed ? seed->origin : domain.holes[defect.first];
            call.log.line("Warning:  %s %zu is %s and has no effect.", hole ? "Hole" : "Region", origin + 1,
                          defect.kind == DELOTET_DEFECT_KIND_SEED_OUTSIDE ? "outside" : "on a facet");
            LeftOut::add(hole ? left_out.holes : left_out.regions, origin);
            break;
        }
        case DELOTET_DEFECT_KIND_DEGENERATE_FACET:
        case DELOTET_DEFECT_KIND_DUPLICATE_FACET: {
            const bool twice = defect.kind == DELOTET_DEFECT_KIND_DUPLICATE_FACET;
            const Index facet = twice ? std::max(defect.first, defect.second) : defect.first;
            if (defect.first_element != DELOTET_ELEMENT_FACET || facet >= domain.facets.size())
                return false;
            // A facet with a ring that is no polygon is another matter than a triangle without area.
            if (!twice && (domain.plc.facet_ring_count(facet) != 1 || domain.plc.facet_ring(facet).size() != 3))
                return false;
            call.log.line("Warning:  Facet %zu %s and is left out.", domain.facets[facet] + 1, twice ? "is given twice" : "has no area");
            LeftOut::add(left_out.facets, domain.facets[facet]);
            break;
        }
        default:
            left_out = before;
            return false;
        }
        found = true;
    }
    return found;
}

Result from_plc(const Call &call, tetgenio &out, bool &enclosed)
{
    LeftOut left_out;
    for (;;) {
        Domain domain = domain_of(call, left_out);
        try {
            Result result;
            result.mesh = mesh_of(call, domain, domain.bounded, {});
            result.rows = numbered_regions(call, domain, result.mesh);
            keep_markers(call, domain, result);
            result.surface = true;
            if (call.switches.docheck) {
                result.mesh.check(domain.plc, false);
                call.log.line("  The mesh is consistent with its input.");
            }
            result.plc = std::move(domain.plc);
            return result;
        } catch (const Exception &failure) {
            if (failure.status() != DELOTET_STATUS_NOTHING_ENCLOSED) {
                if (pass_over(call, failure, domain, left_out))
                    continue;
                throw;
            }
            enclosed = false;
            call.log.line("Warning:  %s", failure.what());
            write_empty_output(call, out);
            return {};
        }
    }
}

/// The points to be inserted that are inside the hull of the others: TetGen passes over the rest.
class PointsInside {
  public:
    explicit PointsInside(const Call &call)
    {
        const tetgenio &from = *call.addin;
        const std::vector<delotet::Point> points = points_of(from);
        const delotet::Mesh hull =
            delotet::tetrahedralize(delotet::Plc(points_of(call.in)), delotet::Options().mode(delotet::Mode::delaunay));
        std::vector<Index> places(points.size());
        hull.locate(points, places, {});
        const auto add = [](auto &to, const auto *list, int width, std::size_t i) {
            if (list && width > 0)
                to.insert(to.end(), list + static_cast<std::size_t>(width) * i, list + static_cast<std::size_t>(width) * (i + 1));
        };
        for (std::size_t i = 0; i < points.size(); i++) {
            if (places[i] == delotet::invalid_index)
                continue;
            add(xyz_, from.pointlist, 3, i);
            add(attributes_, from.pointattributelist, from.numberofpointattributes, i);
            add(sizes_, from.pointmtrlist, from.numberofpointmtrs, i);
            add(markers_, from.pointmarkerlist, 1, i);
        }
        io_.firstnumber = from.firstnumber;
        io_.numberofpoints = count_of(xyz_.size() / 3);
        io_.pointlist = xyz_.data();
        io_.numberofpointattributes = from.numberofpointattributes;
        io_.pointattributelist = from.pointattributelist ? attributes_.data() : nullptr;
        io_.numberofpointmtrs = from.numberofpointmtrs;
        io_.pointmtrlist = from.pointmtrlist ? sizes_.data() : nullptr;
        io_.pointmarkerlist = from.pointmarkerlist ? markers_.data() : nullptr;
    }
    ~PointsInside() { io_.initialize(); } // The arrays are not its own.
    PointsInside(const PointsInside &) = delete;
    PointsInside &operator=(const PointsInside &) = delete;

    const tetgenio *get() const { return io_.numberofpoints > 0 ? &io_ : nullptr; }

  private:
    tetgenio io_;
    std::vector<double> xyz_, attributes_, sizes_;
    std::vector<int> markers_;
};

Result from_points(const Call &call)
{
    std::vector<delotet::Point> points = points_of(call.in);
    Domain domain;
    domain.plc = delotet::Plc(points);
    complete(call, domain, {});
    const PointRows rows = point_rows(call);
    if (call.switches.weighted && rows.attributes > 0) { // The first attribute; without any all weights are equal.
        std::vector<double> weights;
        for (std::size_t i = 0; i < points.size() + call.added_points(); i++)
            weights.push_back(rows.data[rows.width() * i]);
        if (call.switches.weighted_param)
            domain.plc.set_point_heights(weights);
        else
            domain.plc.set_point_weights(weights);
    }
    Result result;
    result.mesh = delotet::tetrahedralize(domain.plc, delotet::Options().mode(delotet::Mode::delaunay));
    return result;
}

/// Switches for which there is nothing in the engine.
void refuse(const Call &call)
{
    const tetgenbehavior &switches = call.switches;
    const Log &log = call.log;
    if (switches.coarsen)
        log.fail(not_offered, "R is not offered: no points are taken out of a mesh.");
    if (switches.psc)
        log.fail(not_offered, "Curved geometry (s) is not offered.");
    if (switches.hole_mesh)
        log.fail(not_offered, "H is not offered: give a point in each hole.");
    if (switches.weighted && (switches.plc || switches.refine))
        log.fail(bad_input, "w goes with neither p nor r.");
    if (switches.noexact)
        log.detail("  X has no effect: all predicates are exact.");
    if (switches.epsilon != 1e-8)
        log.detail("  T has no effect: nothing depends on a tolerance.");
    if (switches.nomergevertex)
        log.detail("  Points are merged if they are equal: what M says of close ones has no effect.");
}

void run_call(Call call, tetgenio &out)
{
    const tetgenbehavior &switches = call.switches;
    refuse(call);
    check_points(call);
    out.firstnumber = switches.zeroindex ? 0 : call.in.firstnumber;
    out.mesh_dim = 3;
    if (switches.plc && switches.diagnose && !switches.refine) {
        const Domain domain = domain_of(call, {});
        const std::size_t found = write_intersections(call, domain, out);
        call.log.line(found > 0 ? "\n  %zu faces are intersecting.\n" : "\nNo faces are intersecting.\n", found);
        return;
    }
    std::optional<PointsInside> inside;
    if (!switches.plc && !switches.refine && call.added_points() > 0) {
        inside.emplace(call);
        call.addin = inside->get();
    }
    bool enclosed = true;
    Result result = switches.refine ? from_mesh(call) : switches.plc ? from_plc(call, out, enclosed) : from_points(call);
    if (enclosed)
        write_output(call, result, out);
    write_summary(call, enclosed ? &result : nullptr, out);
}

} // namespace

void run(const tetgenbehavior &switches, Rules rules, const tetgenio &in, tetgenio &out, const tetgenio *addin, const tetgenio *bgmin,
         std::FILE *log, std::string *why)
{
    const bool inserts = switches.insertaddpoints && addin && addin->numberofpoints > 0 && addin->pointlist;
    const Call call = {switches, rules, in, inserts ? addin : nullptr, bgmin, Log(log, why, switches)};
    try {
        run_call(call, out);
    } catch (const Exception &failure) {
        if (why)
            *why = failure.what();
        throw static_cast<int>(thrown_for(call, failure));
    }
}

} // namespace delotet_tetgen
