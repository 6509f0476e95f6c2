// Two translation units with the wrapper in one program: no symbol is defined twice.
#include "test.hpp"

std::size_t tets_in_b();

int main()
{
    CHECK(delotet::tetrahedralize(cube()).tets().size() == tets_in_b());
    return 0;
}
