// The stages of a run and what they hand on: the input as a PLC or a given mesh, what is wanted of the mesh, and the filled output.
//
// Invariants: the caller's objects are only read. Failures are ints (Thrown), or exceptions of delotet.hpp, which run() turns into ints.
#pragma once

#include "job.hpp"

#include <delotet/delotet.hpp>

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace delotet_tetgen {

using delotet::Index;

constexpr double no_wish = std::numeric_limits<double>::infinity();

/// Lines of text for the user: nowhere without a file.
class Log {
  public:
    Log(std::FILE *file, std::string *why, const tetgenbehavior &switches) : file_(file), why_(why), verbose_(switches.verbose) {}

    void line(const char *format, ...) const __attribute__((format(printf, 2, 3)));
    /// With V only.
    void detail(const char *format, ...) const __attribute__((format(printf, 2, 3)));
    /// Keeps why the run fails, and throws.
    [[noreturn]] void fail(Thrown code, const char *format, ...) const __attribute__((format(printf, 3, 4)));
    bool verbose() const { return verbose_ > 0; }
    explicit operator bool() const { return file_ != nullptr; }

  private:
    std::FILE *file_;
    std::string *why_;
    int verbose_;
};

/// What every stage knows.
struct Call {
    const tetgenbehavior &switches;
    Rules rules;
    const tetgenio &in;
    const tetgenio *addin;  // NULL unless its points are to be inserted
    const tetgenio *bgmin;  // NULL unless it has sizes
    Log log;

    /// The marker of facets and segments without one: 1 in TetGen 1.5, -1 in 1.6.
    int automatic_marker() const { return rules == Rules::v150 ? 1 : -1; }
    std::size_t input_points() const { return static_cast<std::size_t>(in.numberofpoints); }
    std::size_t added_points() const { return addin ? static_cast<std::size_t>(addin->numberofpoints) : 0; }
};

/// The point with the number `number` in `io`; fails if there is none. `what` and `where` are for the message.
Index point_of(const Call &call, const tetgenio &io, int number, const char *what, std::size_t where);

/// Checks what is read in every mode: counts, and the coordinates of the points.
void check_points(const Call &call);
std::vector<delotet::Point> points_of(const tetgenio &io);
/// The edge length wanted at each point of `io` (m): empty without sizes.
std::vector<double> sizes_of(const Call &call, const tetgenio &io);

/// A seed of a region or a hole.
struct Seed {
    delotet::Point at = {};
    int attribute = 0;
    double max_volume = 0;
    bool hole = false;      // a hole that is kept, as c asks for
    std::size_t origin = 0; // its number among the regions, or the holes, of the input
};

/// What is left out of a PLC, since TetGen passes over it, by position in the input.
struct LeftOut {
    std::vector<bool> facets, regions, holes;

    static bool has(const std::vector<bool> &flags, std::size_t i) { return i < flags.size() && flags[i]; }
    static void add(std::vector<bool> &flags, std::size_t i)
    {
        if (flags.size() <= i)
            flags.resize(i + 1);
        flags[i] = true;
    }
};

/// A segment of the input.
struct InputSegment {
    Index ends[2] = {};
    int marker = 0;
    double length = no_wish;  // its largest length
    std::size_t origin = 0;   // the order of the input, for equal ones
    bool marked = false;      // whether the marker was given
};

/// A PLC and what its elements stand for.
struct Domain {
    delotet::Plc plc;
    std::vector<std::size_t> facets;     // of each facet of the PLC, its position in the input
    std::vector<InputSegment> segments;  // of each segment of the PLC
    std::vector<Seed> seeds;             // of each region seed of the PLC
    std::vector<std::size_t> holes;      // of each hole seed of the PLC, its position in the input
    bool bounded = false;                // whether a region has a bound on volumes
};

/// The PLC of a call with p, without what is left out.
Domain domain_of(const Call &call, const LeftOut &left_out);
/// Adds what PLCs have beside facets: points to be inserted, attributes, sizes at the points, segments with bounds, bounds of facets.
void complete(const Call &call, Domain &domain, std::vector<InputSegment> &&segments);

/// A given mesh (r) and what its elements stand for.
struct Given {
    delotet::Mesh mesh;
    std::vector<int> edge_markers;           // of each given edge that is kept
    std::vector<std::vector<double>> rows;   // attributes of tetrahedra, all different; the mesh has their positions as attributes
    std::vector<double> volumes;             // the largest volume wanted in each tetrahedron, empty if there is no wish
};

Given given_mesh(const Call &call);
/// The boundary, facets, regions and points of a given mesh as a PLC. `voids`: a point in each hole.
Domain domain_of(const Call &call, const Given &given, const std::vector<delotet::Point> &voids);

/// The edge length of a regular tetrahedron with this volume.
double length_of_volume(double volume);
/// Whether points come by size or shape.
bool fills(const Call &call, bool bounded);
/// The options of a run. `relaxed`: how often sizes and shapes have been relaxed, to keep a limit on the number of points.
delotet::Options options_of(const Call &call, bool bounded, int relaxed = 0);
/// Gives `options` the background mesh (m); `mesh` is that mesh.
void set_background(const Call &call, delotet::Options &options);

/// Lengths wanted at the points of a mesh; none without a mesh.
struct Background {
    const delotet::Mesh *mesh = nullptr;
    std::vector<double> sizes;
};

/// Makes the mesh of a PLC. `bounded`: whether there are bounds or sizes beside those of the switches.
delotet::Mesh mesh_of(const Call &call, const Domain &domain, bool bounded, const Background &background);

/// Numbers that points carry with them, attributes first, then sizes (m): one row for each point of `in` and of those to be inserted.
struct PointRows {
    std::size_t attributes = 0, sizes = 0;
    std::vector<double> data;

    std::size_t width() const { return attributes + sizes; }
};
PointRows point_rows(const Call &call);

/// A mesh and what the output needs to know of it.
struct Result {
    delotet::Mesh mesh;
    std::vector<int> facet_markers;          // of each facet, for the points on it
    std::vector<int> segment_markers;        // of each segment; a subsegment on none has the automatic marker
    std::vector<std::vector<double>> rows;   // attributes of the tetrahedra, by region of the mesh; empty without attributes
    std::vector<double> point_rows;          // of all points, as PointRows; empty if the mesh has them as attributes
    delotet::Plc plc;                        // with p, what the facets were
    bool surface = false;                    // whether there are facets: with p and r
};

/// The attributes of tetrahedra by region of a mesh.
std::vector<std::vector<double>> numbered_regions(const Call &call, const Domain &domain, const delotet::Mesh &mesh);
/// The markers that edges inherit, and points if they have any.
inline void keep_markers(const Call &call, const Domain &domain, Result &result)
{
    for (const InputSegment &segment : domain.segments)
        result.segment_markers.push_back(segment.marker);
    for (std::size_t i = 0; call.in.pointmarkerlist && i < domain.plc.facet_count(); i++)
        result.facet_markers.push_back(domain.plc.facet_marker(static_cast<Index>(i)));
}

/// The result of a call with r.
Result from_mesh(const Call &call);

/// Whether a failure is one of memory, or of counts that none suffices for.
inline bool memory_ran_out(const delotet::Exception &failure)
{
    return failure.status() == DELOTET_STATUS_OUT_OF_MEMORY || failure.status() == DELOTET_STATUS_MEMORY_LIMIT ||
           failure.status() == DELOTET_STATUS_TOO_LARGE;
}

/// Fills `out` from a mesh.
void write_output(const Call &call, const Result &result, tetgenio &out);
/// The Voronoi diagram of the points of a Delaunay mesh, which have these numbers in `out`; below the first one those that are left out.
void write_voronoi(const delotet::Mesh &mesh, const std::vector<int> &numbers, tetgenio &out);
/// `out` of a domain that encloses nothing: no tetrahedra, and the points only if unused ones stay.
void write_empty_output(const Call &call, tetgenio &out);
/// The facets that intersect others as the faces of `out` (d). Returns how many there are.
std::size_t write_intersections(const Call &call, const Domain &domain, tetgenio &out);

/// Counts of the input and the mesh, as users' programs look for them.
void write_summary(const Call &call, const Result *result, const tetgenio &out);

/// An array of `count` rows of `width`, or NULL if it is empty: for a member of a tetgenio.
template <class T> T *new_array(std::size_t count, std::size_t width = 1)
{
    return count == 0 || width == 0 ? nullptr : new T[count * width];
}

/// A count as a tetgenio has it. Throws std::bad_alloc if it has none such.
int count_of(std::size_t count);

} // namespace delotet_tetgen
