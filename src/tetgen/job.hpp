// A call of tetrahedralize(): from its arguments to the filled output.
#pragma once

#include "model.hpp"

#include <cstdio>
#include <string>

namespace delotet_tetgen {

/// Meshes `in` as `switches` say, and fills `out`, which is empty before. `addin` has the points to be inserted (i), `bgmin` the mesh with
/// sizes (m); NULL without them. Of the inputs nothing is written. `log` receives the summary and what was decided; NULL for silence.
///
/// `why` receives what is wrong if it fails; it may be NULL.
///
/// Arrays of `out` are made by new[]. The numbering of `out` is that of `in`, or 0 with z. Throws a Thrown, as int, or std::bad_alloc;
/// `out` may then be partly filled, and its caller frees it.
void run(const tetgenbehavior &switches, Rules rules, const tetgenio &in, tetgenio &out, const tetgenio *addin,
         const tetgenio *bgmin, std::FILE *log, std::string *why);

} // namespace delotet_tetgen
