// The same through the C++ header.
#include <delotet/delotet.hpp>

#include <iostream>
#include <vector>

int main()
{
    const std::vector<double> xyz = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    const std::vector<delotet::Index> corners = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    delotet::Plc plc(xyz);
    plc.add_triangles(corners);
    const delotet::Mesh mesh = delotet::tetrahedralize(plc);
    std::cout << mesh.tets().size() << " tetrahedron\n";
    return mesh.tets().size() == 1 && delotet::compatible() ? 0 : 1;
}
