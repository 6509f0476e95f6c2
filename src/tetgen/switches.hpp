// The parser of switches, which serves both layouts, the library and the program.
#pragma once

#include "model.hpp"

#include <string>

namespace delotet_tetgen {

/// What 1.5.0 has members for and 1.6.0 has not. Nothing here has an effect; programs may look at it.
struct Legacy {
    int incrflip = 0;
    int conforming = 0;
    int reflevel = 3;
    double optminsmtdihed = 179.0;
    double optminslidihed = 179.0;
    double minedgelength = 0.0;
};

/// How parse() ended.
enum class Parsed { good, help, bad };

/// Sets the defaults of `rules`, which are those of tetgenbehavior's constructor.
void set_defaults(tetgenbehavior &switches, Rules rules);

/// Reads the arguments of a program: switches and the name of a file. `words` do not contain the program's name; with `library` all of them
/// are switches. What is not mentioned keeps its value. `idle` receives the characters that no switch has, which are skipped as TetGen
/// does, and `why` says what is wrong; both may be NULL.
Parsed parse(tetgenbehavior &switches, Legacy &legacy, Rules rules, int count, const char *const *words, bool library,
             std::string *idle, std::string *why);

/// The list of switches.
const char *syntax_text();

} // namespace delotet_tetgen
