// The layout of 1.6.0, in the same program.
#define DELOTET_TETGEN_VERSION 160
#include <tetgen.h>

#include "two_layouts.hpp"

static_assert(sizeof(void *) != 8 || sizeof(tetgenio) == 448, "the layout of 1.6.0");

int cube_160();
int cube_160()
{
    CHECK(tetgenbehavior::NEU_MESH == 8);
    return cube();
}
