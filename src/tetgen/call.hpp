// What both layouts' functions and the program call.
#pragma once

#include "switches.hpp"

#include <cstdio>

namespace delotet_tetgen {

/// Meshes `in` as `switches` say; fills `out`, or writes files where it is NULL. `log` receives the summary, `told` the names of files;
/// `why` what went wrong; all three may be NULL. Returns 0, or throws a Thrown, as int.
int call(const tetgenbehavior &switches, Rules rules, const tetgenio *in, tetgenio *out, const tetgenio *addin,
         const tetgenio *bgmin, std::FILE *log, std::FILE *told, std::string *why);

/// The same for libraries: prints with V only.
int call_library(const tetgenbehavior &switches, Rules rules, const tetgenio *in, tetgenio *out, const tetgenio *addin,
                 const tetgenio *bgmin);

/// Sets defaults, then reads one word of switches. Throws bad_input, as int, if they are not valid.
void read_switches(tetgenbehavior &switches, Legacy &legacy, Rules rules, const char *text);

/// What parse_commandline() does.
bool read_arguments(tetgenbehavior &switches, Legacy &legacy, Rules rules, int argc, const char *const *argv);

} // namespace delotet_tetgen
