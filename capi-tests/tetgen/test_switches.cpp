// The parser against what TetGen makes of the same switches (switches.txt), and against what is known of 1.6.0's.
#include <tetgen.h>

#include "check.hpp"

#include <cstring>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace {

using Fields = std::map<std::string, std::string>;

std::string text(double value)
{
    char digits[40];
    std::snprintf(digits, sizeof(digits), "%.17g", value);
    return digits;
}

/// The fields of `b` that differ from those of `other`.
Fields differences(const tetgenbehavior &b, const tetgenbehavior &other)
{
    Fields found;
#define INT(name)                                                                                    \
    if (b.name != other.name)                                                                        \
        found[#name] = std::to_string(static_cast<int>(b.name));
#define DOUBLE(name)                                                                                 \
    if (b.name < other.name || b.name > other.name)                                                  \
        found[#name] = text(b.name);
#define NAME(name)                                                                                   \
    if (b.name[0] != '\0')                                                                           \
        found[#name] = std::string("'") + b.name + "'";
    INT(plc) INT(psc) INT(refine) INT(quality) INT(nobisect) INT(coarsen) INT(weighted) INT(brio_hilbert)
    INT(incrflip) INT(flipinsert) INT(metric) INT(varvolume) INT(fixedvolume) INT(regionattrib)
    INT(conforming) INT(insertaddpoints) INT(diagnose) INT(convex) INT(nomergefacet) INT(nomergevertex)
    INT(noexact) INT(nostaticfilter) INT(zeroindex) INT(facesout) INT(edgesout) INT(neighout) INT(voroout)
    INT(meditview) INT(vtkview) INT(nobound) INT(nonodewritten) INT(noelewritten) INT(nofacewritten)
    INT(noiterationnum) INT(nojettison) INT(reversetetori) INT(docheck) INT(quiet) INT(verbose)
    INT(vertexperblock) INT(tetrahedraperblock) INT(shellfaceperblock) INT(nobisect_param)
    INT(addsteiner_algo) INT(coarsen_param) INT(weighted_param) INT(fliplinklevel) INT(flipstarsize)
    INT(fliplinklevelinc) INT(reflevel) INT(optlevel) INT(optscheme) INT(delmaxfliplevel) INT(order)
    INT(steinerleft) INT(no_sort) INT(hilbert_order) INT(hilbert_limit) INT(brio_threshold) INT(object)
    DOUBLE(brio_ratio) DOUBLE(facet_ang_tol) DOUBLE(maxvolume) DOUBLE(minratio) DOUBLE(mindihedral)
    DOUBLE(optmaxdihedral) DOUBLE(optminsmtdihed) DOUBLE(optminslidihed) DOUBLE(epsilon)
    DOUBLE(minedgelength) DOUBLE(coarsen_percent)
    NAME(infilename) NAME(outfilename) NAME(addinfilename) NAME(bgmeshfilename)
    return found;
}

Fields measured(const std::string &line)
{
    Fields fields;
    std::istringstream words(line);
    std::string word;
    while (words >> word) {
        const std::size_t equals = word.find('=');
        fields[word.substr(0, equals)] = word.substr(equals + 1);
    }
    return fields;
}

/// Parses switches, or the arguments after '$'; the fields that this changes.
Fields parsed(const std::string &switches)
{
    tetgenbehavior b;
    if (switches[0] != '$') {
        std::vector<char> copy(switches.begin(), switches.end());
        copy.push_back('\0');
        CHECK(b.parse_commandline(copy.data()));
        CHECK(switches == copy.data());
        Fields fields = differences(b, tetgenbehavior());
        // The names that there are without one.
        if (fields["infilename"] == "'tetgen-tmpfile'" && fields["outfilename"] == "'tetgen-tmpfile.1'")
            for (const char *name : {"infilename", "outfilename", "addinfilename", "bgmeshfilename"})
                fields.erase(name);
        return fields;
    }
    std::istringstream line(switches.substr(1));
    std::vector<std::string> words = {"tetgen"};
    std::string word;
    while (line >> word)
        words.push_back(word);
    std::vector<char *> pointers;
    for (std::string &each : words)
        pointers.push_back(&each[0]);
    pointers.push_back(NULL);
    CHECK(b.parse_commandline(static_cast<int>(words.size()), pointers.data()));
    return differences(b, tetgenbehavior());
}

void the_table(const char *path)
{
    std::ifstream file(path);
    CHECK(file.good());
    std::string line;
    int count = 0, wrong = 0;
    while (std::getline(file, line)) {
        const std::size_t tab = line.find('\t');
        if (line[0] == '#' && tab == std::string::npos)
            continue;
        const std::string switches = line.substr(0, tab);
        Fields expected = measured(line.substr(tab + 1)), found = parsed(switches);
        if (found.count("nobisect") != 0 && std::atoi(found["nobisect"].c_str()) > 1)
            found["nobisect"] = "1";
        count++;
        if (found == expected)
            continue;
        wrong++;
        std::fprintf(stderr, "%s:", switches.c_str());
        for (const auto &field : found)
            std::fprintf(stderr, " %s=%s", field.first.c_str(), field.second.c_str());
        std::fprintf(stderr, "\n");
    }
    std::printf("%d strings of switches as TetGen reads them, %d not\n", count - wrong, wrong);
    CHECK(count > 500 && wrong == 0);
}

void refusals()
{
    for (const char *bad : {"pw", "rw", "wp", "h", "p?", "pH"}) {
        tetgenbehavior b;
        std::string copy = bad;
        CHECK(!b.parse_commandline(&copy[0]));
    }
    tetgenbehavior b;
    char program[] = "tetgen", switches[] = "-p";
    char *arguments[] = {program, switches, NULL};
    CHECK(!b.parse_commandline(2, arguments));
    // A name that does not fit is refused, not cut.
    std::string longest(1023, 'x'), longer(1024, 'x');
    for (const std::string &name : {longest, longer}) {
        std::string copy = name;
        char *words[] = {program, switches, &copy[0], NULL};
        CHECK(!tetgenbehavior().parse_commandline(3, words));
    }
    // Switches that do not fit into the line that is kept are read all the same.
    std::string many(5000, 'f');
    many += "pq1.25";
    tetgenbehavior kept;
    CHECK(kept.parse_commandline(&many[0]));
    CHECK(kept.plc == 1 && kept.facesout == 5000 && kept.minratio == 1.25 && std::strlen(kept.commandline) == 1023);
}

} // namespace

int main(int argc, char **argv)
{
    CHECK(argc == 2);
    the_table(argv[1]);
    refusals();
    return 0;
}
