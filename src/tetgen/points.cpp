// Points of a tetgenio, and what is checked of it in every mode.
#include "stages.hpp"

#include <new>

namespace delotet_tetgen {

int count_of(std::size_t count)
{
    if (count > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        throw std::bad_alloc();
    return static_cast<int>(count);
}

Index point_of(const Call &call, const tetgenio &io, int number, const char *what, std::size_t where)
{
    // In 64 bits: no difference of ints overflows there.
    const long long index = static_cast<long long>(number) - io.firstnumber;
    if (index < 0 || index >= io.numberofpoints)
        call.log.fail(bad_input, "There is no point %d, which %s %zu refers to.", number, what, where);
    return static_cast<Index>(index);
}

void check_points(const Call &call)
{
    const tetgenio &in = call.in;
    if (in.numberofpoints <= 0 || !in.pointlist)
        call.log.fail(bad_input, "There are no points.");
    if (in.mesh_dim != 3 && in.mesh_dim != 0)
        call.log.fail(bad_input, "The points have %d dimensions instead of 3.", in.mesh_dim);
}

std::vector<delotet::Point> points_of(const tetgenio &io)
{
    std::vector<delotet::Point> points(io.numberofpoints > 0 ? static_cast<std::size_t>(io.numberofpoints) : 0);
    for (std::size_t i = 0; i < points.size(); i++)
        points[i] = {io.pointlist[3 * i], io.pointlist[3 * i + 1], io.pointlist[3 * i + 2]};
    return points;
}

std::vector<double> sizes_of(const Call &call, const tetgenio &io)
{
    std::vector<double> sizes;
    if (!call.switches.metric || io.numberofpointmtrs <= 0 || !io.pointmtrlist)
        return sizes;
    const std::size_t width = static_cast<std::size_t>(io.numberofpointmtrs);
    const double scale = call.switches.metric_scale > 0 ? call.switches.metric_scale : 1;
    for (std::size_t i = 0; i < static_cast<std::size_t>(io.numberofpoints); i++) {
        // A tensor (3 or 6 numbers) counts by its first number, as in TetGen.
        const double size = io.pointmtrlist[width * i] * scale;
        sizes.push_back(size > 0 ? size : no_wish);
    }
    return sizes;
}

PointRows point_rows(const Call &call)
{
    PointRows rows;
    const tetgenio &in = call.in;
    if (in.numberofpointattributes > 0 && in.pointattributelist)
        rows.attributes = static_cast<std::size_t>(in.numberofpointattributes);
    if (call.switches.metric && in.numberofpointmtrs > 0 && in.pointmtrlist)
        rows.sizes = static_cast<std::size_t>(in.numberofpointmtrs);
    if (rows.width() == 0)
        return rows;
    const auto add = [&](const tetgenio &io) {
        const bool attributes = io.pointattributelist && io.numberofpointattributes == in.numberofpointattributes;
        const bool sizes = io.pointmtrlist && io.numberofpointmtrs == in.numberofpointmtrs;
        for (std::size_t i = 0; i < static_cast<std::size_t>(io.numberofpoints); i++) {
            for (std::size_t k = 0; k < rows.attributes; k++)
                rows.data.push_back(attributes ? io.pointattributelist[rows.attributes * i + k] : 0);
            for (std::size_t k = 0; k < rows.sizes; k++)
                rows.data.push_back(sizes ? io.pointmtrlist[rows.sizes * i + k] : 0);
        }
    };
    add(in);
    if (call.addin)
        add(*call.addin);
    return rows;
}

} // namespace delotet_tetgen
