// The list of switches.
#include "switches.hpp"

namespace delotet_tetgen {

const char *syntax_text()
{
    return "delotet tetgen [SWITCHES] FILE\n"
           "\n"
           "Makes tetrahedral meshes with the switches and files of TetGen. FILE: .node, .poly, .smesh, .off, .ply, .stl,\n"
           ".mesh, .vtk or .ele, or without extension. A number follows its switch without space, further ones after '/'.\n"
           "\n"
           "Input\n"
           "  -p#  a surface; # the angle from which neighbours are one facet (179.9)\n"
           "  -r   a mesh, to be refined\n"
           "  -i   more points, from FILE.a.node\n"
           "  -w   points with weights, their first attribute; -w1 with heights\n"
           "Points that are added\n"
           "  -q#/#  shape: largest radius-edge ratio (2), smallest dihedral angle\n"
           "  -a#    largest volume; without a number by regions, or by .vol with -r\n"
           "  -m     sizes at points (FILE.mtr), or of a mesh (FILE.b.node, FILE.b.ele, FILE.b.mtr)\n"
           "  -Y     none on the outer surface; -YY none on internal facets either\n"
           "  -S#    at most #\n"
           "  -O#    effort of optimisation, 0 to 10\n"
           "What is a facet, what is inside\n"
           "  -A   tetrahedra get the attributes of their regions\n"
           "  -c   keeps what is outside, to the convex hull\n"
           "  -d   finds the facets that intersect\n"
           "  -M   coplanar facets are not merged\n"
           "Output\n"
           "  -z -o2 -f -e -n -nn   numbers from 0; ten nodes; all faces; all edges; neighbours; relations\n"
           "  -g -k -k2             .mesh; .vtk; .vtk of faces\n"
           "  -B -N -E -F           no markers; no .node; no .ele; no .face and .edge\n"
           "  -v                    Voronoi diagram (.v.node, .v.edge, .v.face, .v.cell)\n"
           "  -I -J                 keeps the name; keeps unused points\n"
           "  -C -Q -V -h           checks the mesh; says nothing; says more; this list\n"
           "Without effect: -T -X -b -x -D -l -L -W, since arithmetic is exact and there is one algorithm.\n"
           "Not supported: -R -s (1.5) -H -K.\n";
}

} // namespace delotet_tetgen
