// The switches as TetGen 1.6.0 has them, in its layout.
#define DELOTET_TETGEN_VERSION 160
#include <tetgen.h>

#include "check.hpp"

#include <cmath>
#include <string>

namespace {

tetgenbehavior parsed(const char *switches)
{
    std::string copy = switches;
    tetgenbehavior b;
    CHECK(b.parse_commandline(&copy[0]));
    return b;
}

bool near(double a, double b)
{
    return std::fabs(a - b) <= 1e-12 * std::fabs(b);
}

} // namespace

int main()
{
    tetgenbehavior b = parsed("p170/0.2/12/175");
    CHECK(b.plc == 1 && near(b.facet_separate_ang_tol, 170) && near(b.facet_small_ang_tol, 12) && near(b.collinear_ang_tol, 175));
    CHECK(near(b.optmaxdihedral, 179.9));
    b = parsed("pq1.4/10");
    CHECK(b.quality == 1 && near(b.minratio, 1.4) && near(b.mindihedral, 10));
    b = parsed("pq");
    CHECK(near(b.minratio, 2) && near(b.mindihedral, 3.5) && near(b.optmaxdihedral, 177));
    b = parsed("pa0.001");
    CHECK(b.fixedvolume == 1 && b.quality == 1 && near(b.maxvolume, 0.001) && near(b.maxvolume_length, 0.1 / 3));
    b = parsed("r2/0.5q");
    CHECK(b.refine == 1 && near(b.elem_growth_ratio, 2) && near(b.refine_progress_ratio, 0.5) && b.opt_max_flip_level == 3);
    CHECK(parsed("r").opt_max_flip_level == 0);
    b = parsed("pD3");
    CHECK(b.cdt == 1 && b.cdtrefine == 3);
    b = parsed("pD");
    CHECK(b.cdt == 1 && b.cdtrefine == 7);
    CHECK(parsed("pDY").cdt == 0);
    CHECK(parsed("pY").nobisect == 1 && parsed("pYY").nobisect == 2);
    b = parsed("pO4/3/5");
    CHECK(b.opt_max_flip_level == 4 && b.opt_scheme == 3 && b.opt_iterations == 5);
    b = parsed("pqo2/150/20/30");
    CHECK(b.order == 2 && near(b.optmaxdihedral, 150) && near(b.opt_max_asp_ratio, 20) && near(b.opt_max_edge_ratio, 30));
    b = parsed("pqo/120");
    CHECK(b.order == 1 && near(b.optmaxdihedral, 120));
    b = parsed("ps2/5/0.4");
    CHECK(b.psc == 0 && b.smooth_cirterion == 2 && b.smooth_maxiter == 5 && near(b.smooth_alpha, 0.4));
    b = parsed("pm0.5");
    CHECK(b.metric == 1 && near(b.metric_scale, 0.5));
    CHECK(parsed("pz1").reversetetori == 1 && parsed("pz").reversetetori == 0);
    CHECK(parsed("pk2").vtksurfview == 1 && parsed("pk2").vtkview == 0 && parsed("pk").vtkview == 1);
    CHECK(parsed("pW").nowarning == 1);
    CHECK(parsed("pc").regionattrib == 1);
    CHECK(parsed("pYrmzqQO2/7o/120").opt_max_flip_level == 2);
    b = parsed("cpnnfmQ");
    CHECK(b.neighout == 2 && b.metric == 1 && b.facesout == 1 && b.convex == 1);

    char program[] = "tetgen", switches[] = "-pqH", hole[] = "hole.mesh", input[] = "part.2.poly";
    char *arguments[] = {program, switches, hole, input, NULL};
    tetgenbehavior c;
    CHECK(c.parse_commandline(4, arguments));
    CHECK(c.hole_mesh == 1 && std::string(c.hole_mesh_filename) == hole && std::string(c.outfilename) == "part.3");
    return 0;
}
