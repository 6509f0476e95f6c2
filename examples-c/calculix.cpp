// A cantilever in CalculiX that converges: calculix <ccx> [<mesh.ele> <values.txt>]. The same beam is meshed in several sizes, written as an
// input deck with linear and with second-order tetrahedra, and solved. Poisson's ratio is 0, so the polynomials of the plane cantilever
// (Timoshenko and Goodier, Theory of Elasticity, §21) solve the problem in space exactly: the error of the tip's deflection is known, and
// must fall at the order of the elements. With file names: the finest beam, bent, and the deflection of its points, for a picture.
#include "values.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

enum Side : delotet::Marker { root = 1, tip = 2, along = 3 };

static const double length = 10, height = 1, young = 210000, force = 100;
static const double inertia = height * height * height * height / 12;

/// Along z, where the neutral plane is z = 0. All of the tip sinks by the same.
static double deflection(double x)
{
    return force / (6 * young * inertia) * (height * height * x + (3 * length - x) * x * x);
}

/// How far the root's points are off their plane: sections do not stay plane.
static double warping(double z)
{
    return force * z / (3 * young * inertia) * (z * z - height * height / 4);
}

/// The traction at the tip, whose integral is the force.
static double traction(double z)
{
    return -force / (2 * inertia) * (height * height / 4 - z * z);
}

/// The beam as a box of six polygons.
static delotet::Plc beam()
{
    const double half = height / 2;
    std::vector<delotet::Point> points;
    for (const double x : {0.0, length})
        for (const auto &yz : {std::array<double, 2>{-half, -half}, {half, -half}, {half, half}, {-half, half}})
            points.push_back({x, yz[0], yz[1]});
    delotet::Plc plc(points);
    const auto side = [&](std::vector<int> corners, delotet::Marker marker) { plc.add_facet(corners, std::vector<int>{4}, marker); };
    side({0, 1, 2, 3}, root);
    side({4, 5, 6, 7}, tip);
    for (int i = 0; i < 4; i++)
        side({i, (i + 1) % 4, (i + 1) % 4 + 4, i + 4}, along);
    return plc;
}

/// Forces on the nodes that do the work of the traction: exact, for it is quadratic.
static std::vector<double> loads(const delotet::Mesh &mesh, const std::vector<delotet::Point> &nodes, bool second_order)
{
    // Products of the six quadratic functions of a triangle, integrated: corners, then the middles of ab, bc, ca; in 180ths of the area.
    static const int products[6][6] = {{6, -1, -1, 0, -4, 0},  {-1, 6, -1, 0, 0, -4},  {-1, -1, 6, -4, 0, 0},
                                       {0, 0, -4, 32, 16, 16}, {-4, 0, 0, 16, 32, 16}, {0, -4, 0, 16, 16, 32}};
    std::vector<double> sums(nodes.size(), 0);
    for (std::size_t f = 0; f < mesh.subfaces().size(); f++) {
        const delotet::Subface &face = mesh.subfaces()[f];
        if (face.marker != tip)
            continue;
        std::array<std::size_t, 6> of{};
        for (std::size_t k = 0; k < 3; k++) {
            of[k] = face.corners[k];
            of[3 + k] = mesh.points().size() + mesh.subface_edges()[f][k];
        }
        const auto side = [&](std::size_t k, std::size_t axis) { return nodes[of[k]][axis] - nodes[of[0]][axis]; };
        const double area = std::fabs(side(1, 1) * side(2, 2) - side(1, 2) * side(2, 1)) / 2;
        for (std::size_t i = 0; i < 6; i++) {
            double load = 0;
            for (std::size_t j = 0; j < 6; j++)
                load += area / 180 * products[i][j] * traction(nodes[of[j]][2]);
            if (second_order || i < 3) {
                sums[of[i]] += load;
            } else { // A linear function is a corner's and half of two middles'.
                sums[of[i - 3]] += load / 2;
                sums[of[(i - 2) % 3]] += load / 2;
            }
        }
    }
    return sums;
}

/// Writes `name`.inp. Indices in the file start at 1. Numbers as %.12e: the reader's fields are 20 characters wide.
static void write(const std::string &name, const delotet::Mesh &mesh, bool second_order)
{
    const delotet::SecondOrder second = mesh.second_order(delotet::NodeOrder::vtk); // The order of C3D10.
    std::vector<delotet::Point> nodes(mesh.points().begin(), mesh.points().end());
    nodes.insert(nodes.end(), second.nodes.begin(), second.nodes.end());
    const std::size_t count = second_order ? nodes.size() : mesh.points().size();
    std::FILE *file = std::fopen((name + ".inp").c_str(), "w");
    if (!file)
        std::exit(1);
    std::fprintf(file, "*NODE, NSET=ALL\n");
    for (std::size_t i = 0; i < count; i++)
        std::fprintf(file, "%zu, %.12e, %.12e, %.12e\n", i + 1, nodes[i][0], nodes[i][1], nodes[i][2]);
    std::fprintf(file, "*ELEMENT, TYPE=%s, ELSET=BEAM\n", second_order ? "C3D10" : "C3D4");
    for (std::size_t tet = 0; tet < mesh.tets().size(); tet++) {
        std::fprintf(file, "%zu", tet + 1);
        for (std::size_t k = 0; k < (second_order ? 10 : 4); k++)
            std::fprintf(file, ", %u", second.tets[tet][k] + 1);
        std::fprintf(file, "\n");
    }
    std::fprintf(file, "*MATERIAL, NAME=STEEL\n*ELASTIC\n%.12e, 0\n*SOLID SECTION, ELSET=BEAM, MATERIAL=STEEL\n", young);
    std::fprintf(file, "*STEP\n*STATIC\n*BOUNDARY\n");
    for (std::size_t i = 0; i < count; i++)
        if (nodes[i][0] == 0)
            std::fprintf(file, "%zu, 1, 1, %.12e\n%zu, 2, 3, 0\n", i + 1, warping(nodes[i][2]), i + 1);
    std::fprintf(file, "*CLOAD\n");
    const std::vector<double> of_node = loads(mesh, nodes, second_order);
    for (std::size_t i = 0; i < count; i++)
        if (of_node[i] != 0)
            std::fprintf(file, "%zu, 3, %.12e\n", i + 1, of_node[i]);
    std::fprintf(file, "*NODE PRINT, NSET=ALL\nU\n*END STEP\n");
    std::fclose(file);
}

/// Whether there is such a program. Its exit code does not tell: with -v it is 201.
static bool runs(const std::string &ccx)
{
    std::remove("calculix.log");
    if (std::system(("\"" + ccx + "\" -v > calculix.log 2>&1").c_str()) == -1)
        return false;
    std::FILE *file = std::fopen("calculix.log", "r");
    if (!file)
        return false;
    char line[256];
    bool found = false;
    while (std::fgets(line, sizeof line, file))
        found = found || std::strstr(line, "Version") != nullptr;
    std::fclose(file);
    return found;
}

/// The displacements that `name`.dat lists, one of each node.
static std::vector<delotet::Point> displacements(const std::string &name)
{
    std::vector<delotet::Point> list;
    std::FILE *file = std::fopen((name + ".dat").c_str(), "r");
    if (!file)
        return list;
    char line[256];
    int node;
    delotet::Point u;
    while (std::fgets(line, sizeof line, file))
        if (std::sscanf(line, "%d %lf %lf %lf", &node, &u[0], &u[1], &u[2]) == 4)
            list.push_back(u);
    std::fclose(file);
    return list;
}

/// The mesh with its points displaced, enlarged so that it shows.
static void draw(const delotet::Mesh &mesh, const std::vector<delotet::Point> &u, char **files)
{
    std::vector<delotet::Point> moved(mesh.points().begin(), mesh.points().end());
    std::vector<double> down;
    const double scale = 0.15 * length / deflection(length);
    for (std::size_t i = 0; i < moved.size(); i++) {
        for (std::size_t axis = 0; axis < 3; axis++)
            moved[i][axis] += scale * u[i][axis];
        down.push_back(-u[i][2]);
    }
    delotet::MeshArrays arrays;
    arrays.points = moved;
    arrays.tets = mesh.tets();
    delotet::mesh_from_arrays(arrays).write(delotet::Plc(std::vector<delotet::Point>()), files[0]);
    write_values(files[1], down);
}

/// How far the tip sinks: the mean of its corners.
static double sinking(const delotet::Mesh &mesh, const std::vector<delotet::Point> &u)
{
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < mesh.points().size(); i++)
        if (mesh.points()[i][0] == length) {
            sum -= u[i][2];
            count++;
        }
    return sum / count;
}

int main(int argc, char **argv)
{
    const std::string ccx = argc > 1 ? argv[1] : "ccx";
    if (!runs(ccx)) {
        std::printf("skipped: %s does not run\n", ccx.c_str());
        return 77;
    }
    const double exact = deflection(length);
    bool good = true;
    std::printf("elements      size   tetrahedra   nodes  deflection    error   order\n");
    for (const bool second_order : {false, true}) {
        const std::string name = second_order ? "cantilever_second" : "cantilever_linear";
        double before = 0, order = 0;
        for (const double size : {1.0, 0.5, 0.25, 0.125}) {
            if (second_order && size < 0.25)
                break; // Of the last digits in the solver's output.
            const delotet::Options options = delotet::Options().quality(1.414).size(size).optimize(1);
            const delotet::Mesh mesh = delotet::tetrahedralize(beam(), options);
            write(name, mesh, second_order);
            const int status = std::system(("\"" + ccx + "\" -i " + name + " > " + name + ".log 2>&1").c_str());
            const std::vector<delotet::Point> u = displacements(name);
            if (status != 0 || u.size() < mesh.points().size()) {
                std::printf("%s failed: see %s.log\n", ccx.c_str(), name.c_str());
                return 1;
            }
            const double found = sinking(mesh, u), error = std::fabs(found / exact - 1);
            std::printf("%-12s  %-5g  %10zu  %6zu  %10.6f  %.1e", second_order ? "second order" : "linear", size,
                        mesh.tets().size(), u.size(), found, error);
            if (before > 0) {
                order = std::log2(before / error);
                std::printf("  %5.2f", order);
                good = good && error < before;
            }
            std::printf("\n");
            before = error;
            if (argc > 3 && second_order)
                draw(mesh, u, argv + 2);
        }
        // Linear tetrahedra are too stiff in bending, so coarse ones are not yet at their order, which is 2.
        good = good && (second_order ? order > 3 && before < 1e-4 : order > 1.5 && before < 0.05);
    }
    std::printf("exact %42.6f\n", exact);
    std::printf(good ? "the error falls at the order of the elements\n" : "the order is wrong\n");
    return !good;
}
