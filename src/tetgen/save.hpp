// The files that a mesh in tetgenio is written to.
#pragma once

#include "model.hpp"

#include <string>

namespace delotet_tetgen {

/// Text on its way to a file. What goes wrong is remembered until close().
class Text {
  public:
    /// Opens a file for writing; with `append` text is added to it.
    explicit Text(const std::string &path, bool append = false);
    ~Text();
    Text(const Text &) = delete;
    Text &operator=(const Text &) = delete;

    Text &operator<<(const char *text);
    Text &operator<<(int value);
    /// As few digits as give the same double again, with a point in no language.
    Text &operator<<(double value);
    /// A number in a column, right-justified.
    Text &column(int value, int width);

    /// Whether all of it is in the file; says on stderr if not.
    bool close();

  private:
    void append(const char *text, std::size_t length);

    std::string path_, pending_;
    std::FILE *file_;
    bool failed_ = false;
};

/// How files are written: `nobound` without markers, `last` a comment at their end, NULL for none.
struct Style {
    bool nobound = false;
    const char *last = NULL;
};

bool write_nodes(const tetgenio &io, const std::string &base, const Style &style);
bool write_elements(const tetgenio &io, const std::string &base, const Style &style);
bool write_faces(const tetgenio &io, const std::string &base, const Style &style);
bool write_edges(const tetgenio &io, const std::string &base, const Style &style);
bool write_neighbors(const tetgenio &io, const std::string &base, const Style &style);
bool write_sizes(const tetgenio &io, const std::string &base);
/// .t2f, .t2e and .f2e, of those that there are.
bool write_relations(const tetgenio &io, const std::string &base, const Style &style);
bool write_voronoi(const tetgenio &io, const std::string &base, const Style &style);
bool write_medit(const tetgenio &io, const std::string &base);
bool write_vtk(const tetgenio &io, const std::string &base);
/// The faces alone.
bool write_surface_vtk(const tetgenio &io, const std::string &base);
bool write_poly(const tetgenio &io, const std::string &base);
bool write_smesh(const tetgenio &io, const std::string &base);

/// Writes `out` as switches ask: which files, and under which names. `told` hears of every file, "Writing part.1.node.". Returns false if
/// one of them could not be written.
bool write_files(const tetgenbehavior &switches, const tetgenio &out, std::FILE *told);

} // namespace delotet_tetgen
