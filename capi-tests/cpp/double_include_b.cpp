// The other one: see double_include_a.cpp.
#include "test.hpp"

std::size_t tets_in_b();

std::size_t tets_in_b()
{
    return delotet::tetrahedralize(cube()).tets().size();
}
