// The functions of the layout of TetGen 1.5.0, under the names that programs compiled for it import.
//
// Objects are copied to the model's and back: pointers and numbers, not arrays.
#include "call.hpp"

// The header once more, with the names and the layout of the programs.
#undef tetgenio
#undef tetgenbehavior
#undef DELOTET_TETGEN_H
#undef DELOTET_TETGEN_VERSION
#undef DELOTET_TETGEN_LABEL
#undef DELOTET_TETGEN_SYMBOL
#undef DELOTET_TETGEN_METHOD
#undef DELOTET_TETGEN_INLINE
#define DELOTET_TETGEN_VERSION 150
#include <delotet/tetgen/tetgen.h>

#include <cstring>

using namespace delotet_tetgen;

using Model = delotet_tetgen_io;
using ModelSwitches = delotet_tetgen_behavior;

namespace {

template <class From, class To> void copy_members(const From &from, To &to)
{
    to.firstnumber = from.firstnumber;
    to.mesh_dim = from.mesh_dim;
    to.useindex = from.useindex;
    to.pointlist = from.pointlist;
    to.pointattributelist = from.pointattributelist;
    to.pointmtrlist = from.pointmtrlist;
    to.pointmarkerlist = from.pointmarkerlist;
    to.pointparamlist = from.pointparamlist;
    to.numberofpoints = from.numberofpoints;
    to.numberofpointattributes = from.numberofpointattributes;
    to.numberofpointmtrs = from.numberofpointmtrs;
    to.tetrahedronlist = from.tetrahedronlist;
    to.tetrahedronattributelist = from.tetrahedronattributelist;
    to.tetrahedronvolumelist = from.tetrahedronvolumelist;
    to.neighborlist = from.neighborlist;
    to.numberoftetrahedra = from.numberoftetrahedra;
    to.numberofcorners = from.numberofcorners;
    to.numberoftetrahedronattributes = from.numberoftetrahedronattributes;
    to.facetlist = from.facetlist;
    to.facetmarkerlist = from.facetmarkerlist;
    to.numberoffacets = from.numberoffacets;
    to.holelist = from.holelist;
    to.numberofholes = from.numberofholes;
    to.regionlist = from.regionlist;
    to.numberofregions = from.numberofregions;
    to.facetconstraintlist = from.facetconstraintlist;
    to.numberoffacetconstraints = from.numberoffacetconstraints;
    to.segmentconstraintlist = from.segmentconstraintlist;
    to.numberofsegmentconstraints = from.numberofsegmentconstraints;
    to.trifacelist = from.trifacelist;
    to.trifacemarkerlist = from.trifacemarkerlist;
    to.o2facelist = from.o2facelist;
    to.face2tetlist = from.face2tetlist;
    to.numberoftrifaces = from.numberoftrifaces;
    to.edgelist = from.edgelist;
    to.edgemarkerlist = from.edgemarkerlist;
    to.o2edgelist = from.o2edgelist;
    to.edge2tetlist = from.edge2tetlist;
    to.numberofedges = from.numberofedges;
    to.vpointlist = from.vpointlist;
    to.vedgelist = from.vedgelist;
    to.vfacetlist = from.vfacetlist;
    to.vcelllist = from.vcelllist;
    to.numberofvpoints = from.numberofvpoints;
    to.numberofvedges = from.numberofvedges;
    to.numberofvfacets = from.numberofvfacets;
    to.numberofvcells = from.numberofvcells;
    to.geomhandle = from.geomhandle;
    to.getvertexparamonedge = from.getvertexparamonedge;
    to.getsteineronedge = from.getsteineronedge;
    to.getvertexparamonface = from.getvertexparamonface;
    to.getedgesteinerparamonface = from.getedgesteinerparamonface;
    to.getsteineronface = from.getsteineronface;
    to.tetunsuitable = from.tetunsuitable;
}

/// A model's object that shares the arrays of a program's, and owns none of them.
class Shared {
  public:
    explicit Shared(const tetgenio *io) : given_(io != NULL)
    {
        if (given_)
            copy_members(*io, model);
    }
    ~Shared() { model.initialize(); }
    Shared(const Shared &) = delete;
    Shared &operator=(const Shared &) = delete;

    Model *get() { return given_ ? &model : NULL; }

    Model model;

  private:
    bool given_;
};

template <class Load> bool load(tetgenio &io, Load read)
{
    Shared shared(&io);
    const bool good = read(shared.model);
    copy_members(shared.model, io);
    return good;
}

template <class From, class To> void copy_switches(const From &from, To &to)
{
    to.plc = from.plc;
    to.psc = from.psc;
    to.refine = from.refine;
    to.quality = from.quality;
    to.nobisect = from.nobisect;
    to.coarsen = from.coarsen;
    to.weighted = from.weighted;
    to.brio_hilbert = from.brio_hilbert;
    to.flipinsert = from.flipinsert;
    to.metric = from.metric;
    to.varvolume = from.varvolume;
    to.fixedvolume = from.fixedvolume;
    to.regionattrib = from.regionattrib;
    to.insertaddpoints = from.insertaddpoints;
    to.diagnose = from.diagnose;
    to.convex = from.convex;
    to.nomergefacet = from.nomergefacet;
    to.nomergevertex = from.nomergevertex;
    to.noexact = from.noexact;
    to.nostaticfilter = from.nostaticfilter;
    to.zeroindex = from.zeroindex;
    to.facesout = from.facesout;
    to.edgesout = from.edgesout;
    to.neighout = from.neighout;
    to.voroout = from.voroout;
    to.meditview = from.meditview;
    to.vtkview = from.vtkview;
    to.nobound = from.nobound;
    to.nonodewritten = from.nonodewritten;
    to.noelewritten = from.noelewritten;
    to.nofacewritten = from.nofacewritten;
    to.noiterationnum = from.noiterationnum;
    to.nojettison = from.nojettison;
    to.reversetetori = from.reversetetori;
    to.docheck = from.docheck;
    to.quiet = from.quiet;
    to.verbose = from.verbose;
    to.vertexperblock = from.vertexperblock;
    to.tetrahedraperblock = from.tetrahedraperblock;
    to.shellfaceperblock = from.shellfaceperblock;
    to.nobisect_param = from.nobisect_param;
    to.addsteiner_algo = from.addsteiner_algo;
    to.coarsen_param = from.coarsen_param;
    to.weighted_param = from.weighted_param;
    to.fliplinklevel = from.fliplinklevel;
    to.flipstarsize = from.flipstarsize;
    to.fliplinklevelinc = from.fliplinklevelinc;
    to.optlevel = from.optlevel;
    to.optscheme = from.optscheme;
    to.delmaxfliplevel = from.delmaxfliplevel;
    to.order = from.order;
    to.steinerleft = from.steinerleft;
    to.no_sort = from.no_sort;
    to.hilbert_order = from.hilbert_order;
    to.hilbert_limit = from.hilbert_limit;
    to.brio_threshold = from.brio_threshold;
    to.brio_ratio = from.brio_ratio;
    to.facet_ang_tol = from.facet_ang_tol;
    to.maxvolume = from.maxvolume;
    to.minratio = from.minratio;
    to.mindihedral = from.mindihedral;
    to.optmaxdihedral = from.optmaxdihedral;
    to.epsilon = from.epsilon;
    to.coarsen_percent = from.coarsen_percent;
    memcpy(to.commandline, from.commandline, sizeof(to.commandline));
    memcpy(to.infilename, from.infilename, sizeof(to.infilename));
    memcpy(to.outfilename, from.outfilename, sizeof(to.outfilename));
    memcpy(to.addinfilename, from.addinfilename, sizeof(to.addinfilename));
    memcpy(to.bgmeshfilename, from.bgmeshfilename, sizeof(to.bgmeshfilename));
}

void to_model(const tetgenbehavior &from, ModelSwitches &to)
{
    set_defaults(to, Rules::v150);
    copy_switches(from, to);
    to.cdt = from.conforming;
    to.object = static_cast<ModelSwitches::objecttype>(from.object);
}

int run_shared(const ModelSwitches &switches, tetgenio *in, tetgenio *out, tetgenio *addin, tetgenio *bgmin)
{
    Shared input(in), points(addin), sizes(bgmin);
    Shared output(out);
    call_library(switches, Rules::v150, input.get(), output.get(), points.get(), sizes.get());
    if (out != NULL) {
        copy_members(output.model, *out);
        // There is no place for these.
        delete[] output.model.point2tetlist;
        delete[] output.model.tet2facelist;
        delete[] output.model.tet2edgelist;
        delete[] output.model.face2edgelist;
    }
    return 0;
}

} // namespace

bool tetgenio::load_node(const char *filebasename)
{
    return load(*this, [&](Model &io) { return io.load_node(filebasename); });
}

bool tetgenio::load_edge(const char *filebasename)
{
    return load(*this, [&](Model &io) { return io.load_edge(filebasename); });
}

bool tetgenio::load_face(const char *filebasename)
{
    return load(*this, [&](Model &io) { return io.load_face(filebasename); });
}

bool tetgenio::load_tet(const char *filebasename)
{
    return load(*this, [&](Model &io) { return io.load_tet(filebasename); });
}

bool tetgenio::load_vol(const char *filebasename)
{
    return load(*this, [&](Model &io) { return io.load_vol(filebasename); });
}

bool tetgenio::load_var(const char *filebasename)
{
    return load(*this, [&](Model &io) { return io.load_var(filebasename); });
}

bool tetgenio::load_mtr(const char *filebasename)
{
    return load(*this, [&](Model &io) { return io.load_mtr(filebasename); });
}

bool tetgenio::load_poly(const char *filebasename)
{
    return load(*this, [&](Model &io) { return io.load_poly(filebasename); });
}

bool tetgenio::load_off(const char *filebasename)
{
    return load(*this, [&](Model &io) { return io.load_off(filebasename); });
}

bool tetgenio::load_ply(const char *filebasename)
{
    return load(*this, [&](Model &io) { return io.load_ply(filebasename); });
}

bool tetgenio::load_stl(const char *filebasename)
{
    return load(*this, [&](Model &io) { return io.load_stl(filebasename); });
}

bool tetgenio::load_vtk(const char *filebasename)
{
    return load(*this, [&](Model &io) { return io.load_vtk(filebasename); });
}

bool tetgenio::load_medit(const char *filebasename, int istetmesh)
{
    return load(*this, [&](Model &io) { return io.load_medit(filebasename, istetmesh); });
}

bool tetgenio::load_plc(const char *filebasename, int object)
{
    return load(*this, [&](Model &io) { return io.load_plc(filebasename, object); });
}

bool tetgenio::load_tetmesh(const char *filebasename, int object)
{
    return load(*this, [&](Model &io) { return io.load_tetmesh(filebasename, object); });
}

void tetgenio::save_nodes(const char *filebasename)
{
    Shared(this).model.save_nodes(filebasename);
}

void tetgenio::save_elements(const char *filebasename)
{
    Shared(this).model.save_elements(filebasename);
}

void tetgenio::save_faces(const char *filebasename)
{
    Shared(this).model.save_faces(filebasename);
}

void tetgenio::save_edges(const char *filebasename)
{
    Shared(this).model.save_edges(filebasename);
}

void tetgenio::save_neighbors(const char *filebasename)
{
    Shared(this).model.save_neighbors(filebasename);
}

void tetgenio::save_poly(const char *filebasename)
{
    Shared(this).model.save_poly(filebasename);
}

void tetgenio::save_faces2smesh(const char *filebasename)
{
    Shared(this).model.save_faces2smesh(filebasename);
}

bool tetgenbehavior::parse_commandline(int argc, char **argv)
{
    ModelSwitches model;
    to_model(*this, model);
    Legacy legacy{incrflip, conforming, reflevel, optminsmtdihed, optminslidihed, minedgelength};
    const bool good = read_arguments(model, legacy, Rules::v150, argc, argv);
    copy_switches(model, *this);
    object = static_cast<objecttype>(model.object);
    incrflip = legacy.incrflip;
    conforming = legacy.conforming;
    reflevel = legacy.reflevel;
    optminsmtdihed = legacy.optminsmtdihed;
    optminslidihed = legacy.optminslidihed;
    return good;
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
    ModelSwitches model;
    to_model(*b, model);
    return run_shared(model, in, out, addin, bgmin);
}

int tetrahedralize(char *switches, tetgenio *in, tetgenio *out, tetgenio *addin, tetgenio *bgmin)
{
    ModelSwitches model;
    Legacy legacy;
    read_switches(model, legacy, Rules::v150, switches);
    return run_shared(model, in, out, addin, bgmin);
}
