// The other one: see double_include_a.cpp.
#include "test.hpp"

std::size_t tets_in_b();

std::size_t tets_in_b()
{
    const delotet::Mesh mesh = delotet::tetrahedralize(cube());
    return mesh.tets().size();
}
