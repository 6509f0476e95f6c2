// A cantilever in CalculiX: calculix <ccx>. Writes an input deck with node and element sets made from our markers, runs the solver with
// linear and with second-order tetrahedra, and compares the tip deflection with beam theory.
#include "lattice.hpp"
#include "volume.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <set>
#include <string>

static const double length = 10, height = 1, young = 210000, poisson_ratio = 0.3, force = 100;

/// Writes `name`.inp. Indices in the file start at 1. Numbers as %.12e: the reader's fields are 20 characters wide.
static void write(const std::string &name, const delotet::Mesh &mesh, bool second_order)
{
    const auto points = mesh.points();
    const delotet::SecondOrder second = mesh.second_order(delotet::NodeOrder::vtk); // The order of C3D10.
    const auto face_edges = mesh.subface_edges();
    const std::size_t first_middle = points.size() + 1;

    std::FILE *file = std::fopen((name + ".inp").c_str(), "w");
    if (!file)
        std::exit(1);
    std::fprintf(file, "*NODE, NSET=ALL\n");
    for (std::size_t i = 0; i < points.size(); i++)
        std::fprintf(file, "%zu, %.12e, %.12e, %.12e\n", i + 1, points[i][0], points[i][1], points[i][2]);
    for (std::size_t i = 0; second_order && i < second.nodes.size(); i++)
        std::fprintf(file, "%zu, %.12e, %.12e, %.12e\n", first_middle + i, second.nodes[i][0], second.nodes[i][1],
                     second.nodes[i][2]);
    std::fprintf(file, "*ELEMENT, TYPE=%s, ELSET=BEAM\n", second_order ? "C3D10" : "C3D4");
    for (std::size_t tet = 0; tet < mesh.tets().size(); tet++) {
        std::fprintf(file, "%zu", tet + 1);
        for (std::size_t k = 0; k < (second_order ? 10 : 4); k++)
            std::fprintf(file, ", %u", second.tets[tet][k] + 1);
        std::fprintf(file, "\n");
    }

    // Nodes of a side, and the share of each in a load that is spread evenly over the side.
    std::set<std::size_t> root;
    std::vector<double> share(points.size() + second.nodes.size() + 1, 0);
    for (std::size_t f = 0; f < mesh.subfaces().size(); f++) {
        const delotet::Subface &face = mesh.subfaces()[f];
        double u[3], v[3];
        for (std::size_t axis = 0; axis < 3; axis++) {
            u[axis] = points[face.corners[1]][axis] - points[face.corners[0]][axis];
            v[axis] = points[face.corners[2]][axis] - points[face.corners[0]][axis];
        }
        const double area = std::fabs(u[1] * v[2] - u[2] * v[1]) / 2; // Both end faces are normal to x.
        for (std::size_t k = 0; k < 3; k++) {
            const std::size_t corner = face.corners[k] + 1, middle = first_middle + face_edges[f][k];
            if (face.marker == x_low) {
                root.insert(corner);
                if (second_order)
                    root.insert(middle);
            } else if (face.marker == x_high)
                share[second_order ? middle : corner] += area / 3 / (height * height);
        }
    }
    std::fprintf(file, "*NSET, NSET=ROOT\n");
    for (const std::size_t node : root)
        std::fprintf(file, "%zu,\n", node);
    std::fprintf(file, "*NSET, NSET=TIP\n");
    for (std::size_t i = 0; i < points.size(); i++)
        if (points[i][0] == length)
            std::fprintf(file, "%zu,\n", i + 1);
    std::fprintf(file, "*MATERIAL, NAME=STEEL\n*ELASTIC\n%.12e, %.12e\n", young, poisson_ratio);
    std::fprintf(file, "*SOLID SECTION, ELSET=BEAM, MATERIAL=STEEL\n*BOUNDARY\nROOT, 1, 3\n*STEP\n*STATIC\n*CLOAD\n");
    for (std::size_t node = 1; node < share.size(); node++)
        if (share[node] > 0)
            std::fprintf(file, "%zu, 3, %.12e\n", node, -force * share[node]);
    std::fprintf(file, "*NODE PRINT, NSET=TIP\nU\n*END STEP\n");
    std::fclose(file);
}

/// Mean deflection of the nodes that `name`.dat lists.
static double deflection(const std::string &name)
{
    std::FILE *file = std::fopen((name + ".dat").c_str(), "r");
    if (!file)
        return NAN;
    char line[256];
    double sum = 0, x, y, z;
    int node, count = 0;
    while (std::fgets(line, sizeof line, file))
        if (std::sscanf(line, "%d %lf %lf %lf", &node, &x, &y, &z) == 4) {
            sum -= z;
            count++;
        }
    std::fclose(file);
    return sum / count;
}

int main(int argc, char **argv)
{
    const std::string ccx = argc > 1 ? argv[1] : "ccx";
    const int across = 4;
    const delotet::Mesh mesh = delotet::tetrahedralize(lattice({10 * across, across, across}, height / across));
    // Timoshenko's beam: bending and shear of a square section.
    const double inertia = std::pow(height, 4) / 12, shear = young / (2 * (1 + poisson_ratio));
    const double theory =
        force * std::pow(length, 3) / (3 * young * inertia) + force * length / (5.0 / 6 * shear * height * height);
    bool good = true;
    for (const bool second_order : {false, true}) {
        const std::string name = second_order ? "cantilever_second" : "cantilever_linear";
        write(name, mesh, second_order);
        const int status = std::system(("\"" + ccx + "\" -i " + name + " > " + name + ".log 2>&1").c_str());
        const double tip = deflection(name), ratio = tip / theory;
        // Linear tetrahedra are too stiff in bending; second-order ones must meet the theory.
        const bool right = status == 0 && (second_order ? std::fabs(ratio - 1) < 0.02 : ratio > 0.6 && ratio < 1);
        std::printf("%s: %zu tetrahedra, tip deflection %.6e, theory %.6e, %s\n", second_order ? "second order" : "linear",
                    mesh.tets().size(), tip, theory,
                    !right ? "wrong" : second_order ? "within 2 % of beam theory" : "stiffer, as expected");
        good = good && right;
    }
    return !good;
}
