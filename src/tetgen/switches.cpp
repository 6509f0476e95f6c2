// The only parser of switches.
//
// It follows TetGen 1.5.0 in what it makes of odd strings, as runs of it show (capi-tests/tetgen/switches.txt has them), with two
// exceptions: the number of Ys counts, as later versions have it, and z1 and 1.6.0's switches are known. A number follows its switch
// without space; further ones come after '/' or ','. Digits that belong to no switch are skipped. An exponent is read only after a and T,
// since e is a switch.
#include "switches.hpp"

#include "number.hpp"

#include <climits>
#include <cmath>
#include <cstring>

namespace delotet_tetgen {

namespace {

/// A place in a word of switches.
class Cursor {
  public:
    explicit Cursor(const char *at) : at_(at) {}

    bool done() const { return *at_ == '\0'; }
    char next() { return *at_++; }

    /// A digit from `low` to `high`, if there is one here.
    bool digit(char low, char high, int &value)
    {
        if (*at_ < low || *at_ > high)
            return false;
        value = *at_++ - '0';
        return true;
    }

    /// A number, if there is one here; it starts with a digit or a point.
    bool number(double &value, bool exponent = false)
    {
        const char *end = at_;
        if (!((*end >= '0' && *end <= '9') || *end == '.'))
            return false;
        while ((*end >= '0' && *end <= '9') || *end == '.' ||
               (exponent && (*end == 'e' || *end == '-' || *end == '+')))
            end++;
        double found = 0.0;
        value = read_double(at_, end, found) != NULL ? found : 0.0;
        at_ = end;
        return true;
    }

    /// A number of which only the digits at its beginning count.
    bool integer(int &value, bool exponent = false)
    {
        const char *first = at_;
        double ignored = 0.0;
        if (!number(ignored, exponent))
            return false;
        if (read_int(first, at_, value) == NULL)
            value = *first == '.' ? 0 : INT_MAX;
        return true;
    }

    /// Passes a separator.
    bool separator()
    {
        if (*at_ != '/' && *at_ != ',')
            return false;
        at_++;
        return true;
    }

  private:
    const char *at_;
};

/// Reads the switches of one word.
class Reader {
  public:
    Reader(tetgenbehavior &switches, Legacy &legacy, Rules rules, std::string *idle)
        : b_(switches), legacy_(legacy), later_(rules == Rules::v160), idle_(idle)
    {
    }

    /// Returns false where help is asked for.
    bool read(const char *word)
    {
        Cursor cursor(word);
        while (!cursor.done()) {
            const char letter = cursor.next();
            if (letter == 'h' || letter == '?' || (letter == 'H' && !later_))
                return false;
            if (!flag(letter) && !shape(letter, cursor) && !detail(letter, cursor) && !output(letter, cursor))
                skip(letter);
        }
        return true;
    }

  private:
    /// Switches that are only counted.
    bool flag(char letter)
    {
        switch (letter) {
        case 'd': b_.diagnose = 1; return true;
        case 'i': b_.insertaddpoints = 1; return true;
        case 'A': b_.regionattrib = 1; return true;
        case 'c': b_.convex = 1; return true;
        case 'f': b_.facesout++; return true;
        case 'e': b_.edgesout++; return true;
        case 'n': b_.neighout++; return true;
        case 'v': b_.voroout = 1; return true;
        case 'g': b_.meditview = 1; return true;
        case 'B': b_.nobound = 1; return true;
        case 'N': b_.nonodewritten = 1; return true;
        case 'E': b_.noelewritten = 1; return true;
        case 'F': b_.nofacewritten = 1; return true;
        case 'I': b_.noiterationnum = 1; return true;
        case 'J': b_.nojettison = 1; return true;
        case 'C': b_.docheck++; return true;
        case 'Q': b_.quiet = 1; return true;
        case 'V': b_.verbose++; return true;
        case 'L': b_.flipinsert = 1; return true;
        case 'l': legacy_.incrflip = 1; return true;
        case 'W':
            if (later_)
                b_.nowarning = 1;
            return later_;
        case 'H':
            b_.hole_mesh = 1;
            return true;
        default: return false;
        }
    }

    /// What is meshed, and with which points.
    bool shape(char letter, Cursor &cursor)
    {
        switch (letter) {
        case 'p':
            b_.plc = 1;
            cursor.number(b_.facet_separate_ang_tol);
            if (later_ && cursor.separator()) {
                double ignored = 0.0;
                cursor.number(ignored);
                if (cursor.separator())
                    cursor.number(b_.facet_small_ang_tol);
                if (cursor.separator())
                    cursor.number(b_.collinear_ang_tol);
            }
            return true;
        case 'r':
            b_.refine = 1;
            if (later_) {
                cursor.number(b_.elem_growth_ratio);
                if (cursor.separator())
                    cursor.number(b_.refine_progress_ratio);
            }
            return true;
        case 'q':
            b_.quality = 1;
            cursor.number(b_.minratio);
            if (cursor.separator()) {
                cursor.number(b_.mindihedral);
                if (cursor.separator())
                    cursor.number(b_.optmaxdihedral);
            }
            return true;
        case 'a':
            if (cursor.number(b_.maxvolume, true)) {
                b_.fixedvolume = 1;
                // 1.6.0 also bounds the lengths of edges by it; here it bounds volumes only.
                if (later_)
                    b_.maxvolume_length = std::cbrt(b_.maxvolume) / 3.0;
            } else {
                b_.varvolume = 1;
            }
            return true;
        case 'Y':
            b_.nobisect++;
            cursor.digit('0', '9', b_.supsteiner_level);
            if (cursor.separator())
                cursor.digit('0', '9', b_.addsteiner_algo);
            return true;
        case 'm':
            b_.metric = 1;
            if (later_)
                cursor.number(b_.metric_scale);
            return true;
        case 'w':
            b_.weighted = 1;
            cursor.integer(b_.weighted_param);
            return true;
        case 'R':
            b_.coarsen = 1;
            cursor.digit('0', '9', b_.coarsen_param);
            if (cursor.separator())
                cursor.number(b_.coarsen_percent);
            return true;
        case 'D':
            b_.cdt = 1;
            legacy_.conforming = 1;
            if (later_)
                cursor.digit('1', '7', b_.cdtrefine);
            else
                cursor.digit('1', '3', legacy_.reflevel);
            return true;
        default: return false;
        }
    }

    /// How it is meshed.
    bool detail(char letter, Cursor &cursor)
    {
        int found = 0;
        switch (letter) {
        case 's':
            // In 1.5.0 this asks for curved geometry, in 1.6.0 it has parameters of smoothing.
            if (!later_) {
                b_.psc = 1;
                return true;
            }
            cursor.integer(b_.smooth_cirterion);
            if (cursor.separator())
                cursor.integer(b_.smooth_maxiter);
            if (cursor.separator())
                cursor.number(b_.smooth_alpha);
            return true;
        case 'O':
            cursor.digit('0', '9', b_.opt_max_flip_level);
            if (cursor.separator())
                cursor.digit('0', '7', b_.opt_scheme);
            if (later_ && cursor.separator())
                cursor.integer(b_.opt_iterations);
            return true;
        case 'o':
            if (cursor.digit('2', '2', found))
                b_.order = 2;
            if (cursor.separator())
                cursor.number(b_.optmaxdihedral);
            if (later_ && cursor.separator())
                cursor.number(b_.opt_max_asp_ratio);
            if (later_ && cursor.separator())
                cursor.number(b_.opt_max_edge_ratio);
            return true;
        case 'S': cursor.integer(b_.steinerleft, true); return true;
        case 'T': cursor.number(b_.epsilon, true); return true;
        case 'M':
            b_.nomergefacet = 1;
            b_.nomergevertex = 1;
            cursor.digit('0', '1', b_.nomergefacet);
            if (cursor.separator())
                cursor.digit('0', '1', b_.nomergevertex);
            return true;
        case 'X':
            if (cursor.digit('1', '1', found))
                b_.nostaticfilter = 1;
            else
                b_.noexact = 1;
            return true;
        case 'x':
            if (cursor.integer(found) && found > b_.tetrahedraperblock) {
                b_.tetrahedraperblock = found;
                b_.vertexperblock = found / 2;
                b_.shellfaceperblock = found / 4;
            }
            return true;
        case 'b':
            cursor.integer(b_.brio_threshold);
            if (cursor.separator())
                cursor.number(b_.brio_ratio);
            if (cursor.separator())
                cursor.integer(b_.hilbert_limit);
            if (cursor.separator())
                cursor.integer(b_.hilbert_order);
            if (b_.brio_threshold == 0 || b_.brio_ratio >= 1.0)
                b_.brio_hilbert = 0;
            if (b_.brio_ratio >= 1.0)
                b_.no_sort = 1;
            return true;
        default: return false;
        }
    }

    /// What is written.
    bool output(char letter, Cursor &cursor)
    {
        int found = 0;
        switch (letter) {
        case 'z':
            b_.zeroindex = 1;
            if (later_ && cursor.digit('1', '1', found))
                b_.reversetetori = 1;
            return true;
        case 'k':
            if (later_ && cursor.digit('2', '2', found))
                b_.vtksurfview = 1;
            else
                b_.vtkview = 1;
            return true;
        default: return false;
        }
    }

    void skip(char letter)
    {
        const bool expected = (letter >= '0' && letter <= '9') || strchr("./,-+ \t", letter) != NULL;
        if (!expected && idle_ != NULL && idle_->find(letter) == std::string::npos)
            idle_->push_back(letter);
    }

    tetgenbehavior &b_;
    Legacy &legacy_;
    const bool later_;
    std::string *idle_;
};

struct Extension {
    const char *text;
    tetgenbehavior::objecttype object;
};

constexpr Extension extensions[] = {
    {".node", tetgenbehavior::NODES}, {".poly", tetgenbehavior::POLY}, {".smesh", tetgenbehavior::POLY},
    {".off", tetgenbehavior::OFF},    {".ply", tetgenbehavior::PLY},   {".stl", tetgenbehavior::STL},
    {".mesh", tetgenbehavior::MEDIT}, {".vtk", tetgenbehavior::VTK},   {".ele", tetgenbehavior::MESH},
};

/// Takes the extension from the name of the input, and what it says.
void use_extension(tetgenbehavior &b, std::string &name)
{
    for (const Extension &known : extensions) {
        const std::size_t length = strlen(known.text);
        if (name.size() < length || name.compare(name.size() - length, length, known.text) != 0)
            continue;
        name.resize(name.size() - length);
        b.object = known.object;
        if (known.object == tetgenbehavior::MESH)
            b.refine = 1;
        else if (known.object == tetgenbehavior::VTK)
            b.plc = 1;
        else if (known.object != tetgenbehavior::NODES && !b.refine)
            b.plc = 1;
        return;
    }
}

/// The name of the output: part.1 gives part.2, part gives part.1.
std::string output_name(const std::string &input)
{
    const std::size_t point = input.rfind('.');
    int iteration = 0;
    if (point != std::string::npos && point + 1 < input.size()) {
        const char *end = input.c_str() + input.size();
        const char *text = input.c_str() + point + 1;
        if (*text >= '0' && *text <= '9' && read_int(text, end, iteration) == end && iteration < INT_MAX)
            return input.substr(0, point + 1) + std::to_string(iteration + 1);
    }
    return input + ".1";
}

bool copy_name(char (&to)[1024], const std::string &from)
{
    if (from.size() >= sizeof(to))
        return false;
    memcpy(to, from.c_str(), from.size() + 1);
    return true;
}

/// Names of all files.
bool set_names(tetgenbehavior &b, std::string name)
{
    use_extension(b, name);
    return copy_name(b.infilename, name) && copy_name(b.outfilename, b.noiterationnum ? name : output_name(name)) &&
           copy_name(b.addinfilename, name + ".a") && copy_name(b.bgmeshfilename, name + ".b");
}

/// What some switches imply for others. False for a combination that there is not.
bool combine(tetgenbehavior &b, Legacy &legacy, Rules rules)
{
    if (b.diagnose)
        b.plc = 1;
    if (!b.plc && !b.refine && (b.quality || b.nobisect || b.fixedvolume))
        b.plc = 1;
    if (b.refine && !b.quality && !b.insertaddpoints && !b.coarsen)
        b.opt_max_flip_level = 0;
    if (!b.plc && !b.refine)
        b.varvolume = 0;
    if (!b.plc || b.refine)
        b.regionattrib = 0;
    if (b.fixedvolume || b.varvolume)
        b.quality = 1;
    if (b.plc && !b.refine && b.convex)
        b.regionattrib = 1;
    if (!b.quality) {
        b.optmaxdihedral = rules == Rules::v160 ? 179.9 : b.nobisect ? 179.0 : 179.999;
        legacy.optminsmtdihed = 179.999;
        legacy.optminslidihed = 179.999;
    }
    if (rules == Rules::v160 && b.nobisect)
        b.cdt = 0;
    return !(b.weighted && (b.plc || b.refine));
}

} // namespace

void set_defaults(tetgenbehavior &switches, Rules rules)
{
    switches.initialize();
    if (rules == Rules::v150) {
        switches.mindihedral = 0.0;
        switches.optmaxdihedral = 165.0;
        switches.opt_max_flip_level = 2;
    }
}

Parsed parse(tetgenbehavior &switches, Legacy &legacy, Rules rules, int count, const char *const *words, bool library,
             std::string *idle, std::string *why)
{
    std::string line = library ? "" : "tetgen ";
    std::string name = library ? "tetgen-tmpfile" : "";
    Reader reader(switches, legacy, rules, idle);
    bool named = library;
    for (int i = 0; i < count; i++) {
        line.append(words[i]).push_back(' ');
        if (!library && words[i][0] != '-') {
            name = words[i];
            named = true;
        } else if (!reader.read(words[i])) {
            return Parsed::help;
        }
        // 1.6.0: the word after H names the mesh of a hole.
        if (!library && words[i][0] == '-' && switches.hole_mesh && switches.hole_mesh_filename[0] == '\0' &&
            strchr(words[i], 'H') != NULL && i + 1 < count) {
            i++;
            line.append(words[i]).push_back(' ');
            if (!copy_name(switches.hole_mesh_filename, words[i])) {
                if (why != NULL)
                    *why = "a file's name is too long";
                return Parsed::bad;
            }
        }
    }
    if (line.size() >= sizeof(switches.commandline))
        line.resize(sizeof(switches.commandline) - 1);
    copy_name(switches.commandline, line);
    if (!named)
        return Parsed::help;
    if (!set_names(switches, name)) {
        if (why != NULL)
            *why = "a file's name is too long";
        return Parsed::bad;
    }
    if (!combine(switches, legacy, rules)) {
        if (why != NULL)
            *why = "w cannot be combined with p or r";
        return Parsed::bad;
    }
    return Parsed::good;
}

} // namespace delotet_tetgen
