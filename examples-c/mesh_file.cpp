// From file to file: mesh_file <surface> <mesh>. The extensions determine the formats.
#include "volume.hpp"

#include <iostream>

int main(int argc, char **argv)
try {
    if (argc != 3) {
        std::cerr << "usage: mesh_file <surface> <mesh>\n";
        return 2;
    }
    const delotet::Plc plc = delotet::Plc::read(argv[1]);
    std::cout << plc.points().size() << " points, " << plc.facet_count() << " facets in " << argv[1] << "\n";
    const delotet::Mesh mesh = delotet::tetrahedralize(plc);
    mesh.write(plc, argv[2]);
    std::cout << "volume " << volume(mesh) << ", written to " << argv[2] << "\n";
} catch (const delotet::Exception &e) {
    std::cerr << delotet_status_name(e.status()) << ": " << e.what() << "\n";
    return 1;
}
