// The layout of 1.5.0, which is the default. A class that is only declared, and a subclass, are what some programs have.
class tetgenio;
int later(tetgenio *io);
int cube_160();

#include <tetgen.h>

#include "two_layouts.hpp"

static_assert(sizeof(void *) != 8 || sizeof(tetgenio) == 392, "the layout of 1.5.0");

namespace {
struct Derived : public tetgenio {
    int own = 5;
};
} // namespace

int later(tetgenio *io)
{
    return io->numberofcorners;
}

int main()
{
    struct tetgenio plain; // as in C
    Derived derived;
    CHECK(later(&plain) == 4 && later(&derived) == 4 && derived.own == 5);
    REAL number = 1;
    CHECK(number > 0 && tetgenbehavior::MESH == 7);
    int thrown = 0;
    try {
        terminatetetgen(NULL, 3);
    } catch (int code) {
        thrown = code;
    }
    CHECK(thrown == 3);
    CHECK(cube() == cube_160());
    return 0;
}
