// What the readers share.
#pragma once

#include "lines.hpp"
#include "model.hpp"

#include <new>
#include <string>
#include <vector>

namespace delotet_tetgen {

/// A list of points, as .node and .poly have it.
struct Points {
    int first = 0;
    int attributes = 0;
    bool marked = false;
    std::vector<double> xyz;
    std::vector<double> attribute;
    std::vector<int> marker;

    int count() const { return static_cast<int>(xyz.size() / 3); }
};

/// Reads the list at the current line of a file, which is its header. Says what is wrong.
bool read_points(Lines &lines, Points &points);

/// Makes them the points of `io`.
void use_points(tetgenio &io, const Points &points);

/// Facets while they are read.
class Facets {
  public:
    /// A facet without polygons.
    void add() { list_.emplace_back(); }
    /// A polygon of the last facet.
    void add_polygon(const std::vector<int> &corners) { list_.back().polygons.push_back(corners); }
    /// The seed of a hole in the last facet.
    void add_hole(const double (&seed)[3]) { list_.back().holes.insert(list_.back().holes.end(), seed, seed + 3); }

    /// One for each facet, or none at all.
    std::vector<int> markers;

    /// Makes them the facets of `io`.
    void use(tetgenio &io) const;

  private:
    struct Facet {
        std::vector<std::vector<int>> polygons;
        std::vector<double> holes;
    };
    std::vector<Facet> list_;
};

/// Calls a reader: memory that runs out is a failure like others.
template <class Read> bool attempt(const std::string &path, Read read)
{
    try {
        return read();
    } catch (const std::bad_alloc &) {
        std::fprintf(stderr, "%s: memory ran out\n", path.c_str());
        return false;
    }
}

/// Reads `path`, which must exist unless it is `optional`; `read` gets the lines.
template <class Read> bool with_file(const std::string &path, bool optional, Read read)
{
    return attempt(path, [&] {
        Lines lines(path);
        if (lines.opened())
            return read(lines);
        if (!optional)
            std::fprintf(stderr, "%s: cannot be read\n", path.c_str());
        return false;
    });
}

} // namespace delotet_tetgen
