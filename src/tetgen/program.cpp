// The program: files in, files out.
//
// Exit codes: 0 done; 1 usage, and what is not offered; otherwise the int that the library throws, such as 3 for an input that intersects
// itself and 10 for one that cannot be read.
#include "call.hpp"

#include <cstring>
#include <exception>
#include <new>

namespace delotet_tetgen {

namespace {

constexpr int usage = 1;

bool exists(const std::string &path)
{
    std::FILE *file = std::fopen(path.c_str(), "rb");
    if (file != NULL)
        std::fclose(file);
    return file != NULL;
}

/// The file that is read first, for the user.
std::string opened(const tetgenbehavior &b)
{
    const std::string name = b.infilename;
    switch (b.object) {
    case tetgenbehavior::POLY: return name + (exists(name + ".poly") ? ".poly" : ".smesh");
    case tetgenbehavior::OFF: return name + ".off";
    case tetgenbehavior::PLY: return name + ".ply";
    case tetgenbehavior::STL: return name + ".stl";
    case tetgenbehavior::MEDIT: return name + ".mesh";
    case tetgenbehavior::VTK: return name + ".vtk";
    default: break;
    }
    return name + (b.plc && !b.refine && exists(name + ".poly") ? ".poly" : ".node");
}

/// Reads the input.
bool load(tetgenbehavior &b, tetgenio &in)
{
    if (b.refine)
        return in.load_tetmesh(b.infilename, b.object);
    if (!b.plc)
        return b.object == tetgenbehavior::NODES ? in.load_plc(b.infilename, tetgenbehavior::NODES)
                                                 : in.load_plc(b.infilename, b.object);
    // A name without extension is that of a surface, if there is one.
    const std::string name = b.infilename;
    const bool poly = exists(name + ".poly") || exists(name + ".smesh") || !exists(name + ".node");
    return in.load_plc(b.infilename, b.object == tetgenbehavior::NODES && poly ? tetgenbehavior::POLY : b.object);
}

/// Reads the background mesh: its tetrahedra and sizes.
bool load_background(tetgenbehavior &b, tetgenio &background)
{
    return background.load_node(b.bgmeshfilename) && background.load_tet(b.bgmeshfilename) &&
           background.load_mtr(b.bgmeshfilename);
}

int run_program(int count, const char *const *words)
{
    tetgenbehavior b;
    Legacy legacy;
    std::string idle, why;
    set_defaults(b, Rules::v160);
    // The shape asked for by q alone is that of both versions: no smallest angle.
    b.mindihedral = 0.0;
    const Parsed parsed = parse(b, legacy, Rules::v160, count, words, false, &idle, &why);
    if (parsed != Parsed::good) {
        const bool asked = count > 0 && words[0][0] == '-' && (strchr(words[0], 'h') != NULL || strchr(words[0], '?') != NULL);
        std::FILE *const to = asked ? stdout : stderr;
        if (parsed == Parsed::bad)
            std::fprintf(to, "error: %s\n", why.c_str());
        else
            std::fputs(syntax_text(), to);
        return asked && parsed == Parsed::help ? 0 : usage;
    }
    if (idle.find('K') != std::string::npos) {
        std::fputs("error: K is not offered\n", stderr);
        return usage;
    }
    if (!idle.empty())
        std::fprintf(stderr, "warning: no switches: '%s'; -h lists all\n", idle.c_str());
    std::FILE *const log = b.quiet ? NULL : stdout;
    if (log != NULL)
        std::fprintf(log, "Opening %s.\n", opened(b).c_str());
    tetgenio in, points, background;
    if (!load(b, in))
        return bad_input;
    const bool added = b.insertaddpoints && exists(std::string(b.addinfilename) + ".node");
    if (added && !points.load_node(b.addinfilename))
        return bad_input;
    if (b.insertaddpoints && !added)
        std::fprintf(stderr, "warning: there is no %s.node, so -i has no effect\n", b.addinfilename);
    const bool sized = b.metric && exists(std::string(b.bgmeshfilename) + ".node");
    if (sized && !load_background(b, background))
        return bad_input;
    if (b.metric && !sized && in.numberofpointmtrs == 0)
        std::fprintf(stderr, "warning: there is no %s.mtr and no %s.node, so -m has no effect\n", b.infilename, b.bgmeshfilename);
    try {
        return call(b, Rules::v160, &in, NULL, added ? &points : NULL, sized ? &background : NULL, log, log, &why);
    } catch (int thrown) {
        if (thrown == out_of_memory && why.empty())
            why = "memory ran out";
        std::fprintf(stderr, "error: %s\n", why.empty() ? "the mesh could not be made" : why.c_str());
        return thrown == not_offered ? usage : thrown;
    }
}

} // namespace
} // namespace delotet_tetgen

/// The program on its arguments, without its name; returns the exit code. Nothing is thrown.
extern "C" int delotet_tetgen_main(int count, const char *const *words)
{
    try {
        const int code = delotet_tetgen::run_program(count, words);
        std::fflush(stdout);
        return code;
    } catch (const std::bad_alloc &) {
        std::fputs("error: memory ran out\n", stderr);
        return delotet_tetgen::out_of_memory;
    } catch (...) {
        std::fputs("error: internal; please report it with the input\n", stderr);
        return delotet_tetgen::internal_error;
    }
}
