// Two translation units with the wrapper in one program: no symbol is defined twice.
#include "test.hpp"

std::size_t tets_in_b();

int main()
{
    const delotet::Mesh mesh = delotet::tetrahedralize(cube());
    CHECK(mesh.tets().size() == tets_in_b());
    return 0;
}
