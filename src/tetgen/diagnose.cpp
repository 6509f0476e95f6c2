// What d asks for: the facets that intersect others.
#include "stages.hpp"

#include <algorithm>
#include <set>

namespace delotet_tetgen {

std::size_t write_intersections(const Call &call, const Domain &domain, tetgenio &out)
{
    out.numberofcorners = 4;
    delotet::Options options;
    options.keep_hull(true); // Whether something is enclosed is another question.
    options.max_defects(std::numeric_limits<std::size_t>::max());
    delotet::Error error;
    if (domain.plc.check(options, error) == DELOTET_STATUS_OK)
        return 0;
    std::set<Index> facets;
    for (const delotet::Defect &defect : error.defects()) {
        switch (defect.kind) {
        case DELOTET_DEFECT_KIND_RING_INTERSECTION:
        case DELOTET_DEFECT_KIND_NON_PLANAR_FACET:
        case DELOTET_DEFECT_KIND_DUPLICATE_FACET:
        case DELOTET_DEFECT_KIND_SEGMENT_SEGMENT:
        case DELOTET_DEFECT_KIND_SEGMENT_FACET:
        case DELOTET_DEFECT_KIND_FACET_FACET:
        case DELOTET_DEFECT_KIND_OVERLAP:
            if (defect.first_element == DELOTET_ELEMENT_FACET)
                facets.insert(defect.first);
            if (defect.second_element == DELOTET_ELEMENT_FACET)
                facets.insert(defect.second);
            break;
        default:
            break;
        }
    }
    const DelotetStatus status = error.status();
    if (status != DELOTET_STATUS_SELF_INTERSECTION && status != DELOTET_STATUS_NON_PLANAR_FACET && status != DELOTET_STATUS_DEGENERATE_FACET)
        throw delotet::Exception(std::move(error));
    const tetgenio &in = call.in;
    const std::size_t count = call.input_points();
    out.numberofpoints = in.numberofpoints;
    out.pointlist = new_array<double>(count, 3);
    std::copy(in.pointlist, in.pointlist + 3 * count, out.pointlist);
    if (in.pointmarkerlist && !call.switches.nobound) {
        out.pointmarkerlist = new_array<int>(count);
        std::copy(in.pointmarkerlist, in.pointmarkerlist + count, out.pointmarkerlist);
    }
    std::vector<int> corners, markers;
    for (const Index facet : facets)
        for (std::size_t ring = 0; ring < domain.plc.facet_ring_count(facet); ring++) {
            const delotet::Span<const Index> around = domain.plc.facet_ring(facet, ring);
            for (std::size_t k = 2; k < around.size(); k++) { // A fan says where a polygon is.
                for (const Index corner : {around[0], around[k - 1], around[k]})
                    corners.push_back(static_cast<int>(corner) + out.firstnumber);
                markers.push_back(domain.plc.facet_marker(facet));
            }
        }
    out.numberoftrifaces = count_of(markers.size());
    out.trifacelist = new_array<int>(markers.size(), 3);
    std::copy(corners.begin(), corners.end(), out.trifacelist);
    out.trifacemarkerlist = new_array<int>(markers.size());
    std::copy(markers.begin(), markers.end(), out.trifacemarkerlist);
    return markers.size();
}

} // namespace delotet_tetgen
