// The classes of tetgen.h as the implementation knows them: one model serves both layouts.
//
// It has the layout of 1.6.0, whose members include all of 1.5.0 that have an effect. So objects of programs in that layout are used
// as they are; legacy.cpp copies the pointers and counts of objects in the other one. The classes have names of their own here, so that
// nothing in the library's objects can be taken for the functions of a program's classes.
#pragma once

#ifdef DELOTET_TETGEN_H
#error "model.hpp must come before tetgen.h"
#endif
#define DELOTET_TETGEN_VERSION 160
#define tetgenio delotet_tetgen_io
#define tetgenbehavior delotet_tetgen_behavior
#include <delotet/tetgen/tetgen.h>

namespace delotet_tetgen {

/// Whose rules apply where TetGen's versions differ.
enum class Rules { v150 = 150, v160 = 160 };

/// The ints that tetrahedralize() throws.
enum Thrown : int {
    out_of_memory = 1,
    internal_error = 2,
    self_intersection = 3,
    small_feature = 4,
    close_facets = 5,
    bad_input = 10,
    not_offered = 11, // bad_input to those outside; the program tells them apart
    steiner_on_surface = 200
};

} // namespace delotet_tetgen
