// tetrahedralize() and tetgenbehavior, for programs in the layout of 1.6.0 and for the other files here.
#include "call.hpp"

#include "job.hpp"
#include "save.hpp"

#include <exception>
#include <new>

namespace delotet_tetgen {

namespace {

/// Hands what was made over to a program's object. What the object had in these places is forgotten, not freed: it may share arrays with
/// the input, and programs rely on that.
void hand_over(tetgenio &made, tetgenio &out)
{
    out.firstnumber = made.firstnumber;
    out.mesh_dim = made.mesh_dim;
    out.pointlist = made.pointlist;
    out.pointattributelist = made.pointattributelist;
    out.pointmtrlist = made.pointmtrlist;
    out.pointmarkerlist = made.pointmarkerlist;
    out.point2tetlist = made.point2tetlist;
    out.numberofpoints = made.numberofpoints;
    out.numberofpointattributes = made.numberofpointattributes;
    out.numberofpointmtrs = made.numberofpointmtrs;
    out.tetrahedronlist = made.tetrahedronlist;
    out.tetrahedronattributelist = made.tetrahedronattributelist;
    out.tetrahedronvolumelist = made.tetrahedronvolumelist;
    out.neighborlist = made.neighborlist;
    out.tet2facelist = made.tet2facelist;
    out.tet2edgelist = made.tet2edgelist;
    out.numberoftetrahedra = made.numberoftetrahedra;
    out.numberofcorners = made.numberofcorners;
    out.numberoftetrahedronattributes = made.numberoftetrahedronattributes;
    out.trifacelist = made.trifacelist;
    out.trifacemarkerlist = made.trifacemarkerlist;
    out.o2facelist = made.o2facelist;
    out.face2tetlist = made.face2tetlist;
    out.face2edgelist = made.face2edgelist;
    out.numberoftrifaces = made.numberoftrifaces;
    out.edgelist = made.edgelist;
    out.edgemarkerlist = made.edgemarkerlist;
    out.o2edgelist = made.o2edgelist;
    out.edge2tetlist = made.edge2tetlist;
    out.numberofedges = made.numberofedges;
    out.vpointlist = made.vpointlist;
    out.vedgelist = made.vedgelist;
    out.vfacetlist = made.vfacetlist;
    out.vcelllist = made.vcelllist;
    out.numberofvpoints = made.numberofvpoints;
    out.numberofvedges = made.numberofvedges;
    out.numberofvfacets = made.numberofvfacets;
    out.numberofvcells = made.numberofvcells;
    made.initialize();
}

} // namespace

int call(const tetgenbehavior &switches, Rules rules, const tetgenio *in, tetgenio *out, const tetgenio *addin,
         const tetgenio *bgmin, std::FILE *log, std::FILE *told, std::string *why)
{
    try {
        if (in == NULL)
            throw static_cast<int>(bad_input);
        tetgenio made;
        if (out != NULL) {
            run(switches, rules, *in, made, addin, bgmin, log, why);
        } else {
            // What is not written as .node, .ele or .face may still be wanted in other files.
            tetgenbehavior all = switches;
            all.nonodewritten = all.noelewritten = all.nofacewritten = 0;
            run(all, rules, *in, made, addin, bgmin, log, why);
        }
        if (out != NULL)
            hand_over(made, *out);
        else if (!write_files(switches, made, told))
            throw static_cast<int>(bad_input);
        return 0;
    } catch (int) {
        throw;
    } catch (const std::bad_alloc &) {
        throw static_cast<int>(out_of_memory);
    } catch (const std::exception &) {
        throw static_cast<int>(internal_error);
    }
}

int call_library(const tetgenbehavior &switches, Rules rules, const tetgenio *in, tetgenio *out, const tetgenio *addin,
                 const tetgenio *bgmin)
{
    std::FILE *const log = switches.verbose > 0 && !switches.quiet ? stdout : NULL;
    std::string why;
    try {
        return call(switches, rules, in, out, addin, bgmin, log, NULL, &why);
    } catch (int thrown) {
        if (log != NULL && !why.empty())
            std::fprintf(log, "%s\n", why.c_str());
        throw thrown == not_offered ? static_cast<int>(bad_input) : thrown;
    }
}

void read_switches(tetgenbehavior &switches, Legacy &legacy, Rules rules, const char *text)
{
    const char *const words[] = {text == NULL ? "" : text};
    set_defaults(switches, rules);
    std::string why;
    try {
        if (parse(switches, legacy, rules, 1, words, true, NULL, &why) == Parsed::good)
            return;
    } catch (const std::bad_alloc &) {
        throw static_cast<int>(out_of_memory);
    }
    throw static_cast<int>(bad_input);
}

bool read_arguments(tetgenbehavior &switches, Legacy &legacy, Rules rules, int argc, const char *const *argv)
{
    std::string why;
    try {
        // TetGen's own calls give one word of switches as argv[0] of no arguments.
        const bool library = argc == 0;
        switch (parse(switches, legacy, rules, library ? 1 : argc - 1, argv + (library ? 0 : 1), library, NULL, &why)) {
        case Parsed::good: return true;
        case Parsed::help: std::fputs(syntax_text(), stdout); return false;
        default: break;
        }
    } catch (const std::bad_alloc &) {
        std::fputs("memory ran out\n", stderr);
        return false;
    }
    std::fprintf(stderr, "%s\n", why.c_str());
    return false;
}

} // namespace delotet_tetgen

using namespace delotet_tetgen;

bool tetgenbehavior::parse_commandline(int argc, char **argv)
{
    Legacy legacy;
    return read_arguments(*this, legacy, Rules::v160, argc, argv);
}

void tetgenbehavior::syntax()
{
    std::fputs(syntax_text(), stdout);
}

void tetgenbehavior::usage()
{
    std::fputs(syntax_text(), stdout);
}

int tetrahedralize(tetgenbehavior *b, tetgenio *in, tetgenio *out, tetgenio *addin, tetgenio *bgmin)
{
    if (b == NULL)
        throw static_cast<int>(bad_input);
    return call_library(*b, Rules::v160, in, out, addin, bgmin);
}

int tetrahedralize(char *switches, tetgenio *in, tetgenio *out, tetgenio *addin, tetgenio *bgmin)
{
    tetgenbehavior b;
    Legacy legacy;
    read_switches(b, legacy, Rules::v160, switches);
    return tetrahedralize(&b, in, out, addin, bgmin);
}
