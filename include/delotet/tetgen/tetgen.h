/* The classes tetgenio and tetgenbehavior and the function tetrahedralize(), for programs written for TetGen. MIT OR Apache-2.0.
 *
 * Written from the interface as programs use it: names, layouts and behaviour; no line comes from TetGen. src/doc/tetgen.md says what is
 * offered and what differs.
 *
 * Layouts: define DELOTET_TETGEN_VERSION as 150 (TetGen 1.5.0, the default) or 160 (TetGen 1.6.0) before including. All files that
 * exchange objects of these classes need the same one.
 *
 * Arrays: allocated by new[], on both sides; every array that an object still points to is freed by its destructor, clean_memory() or
 * deinitialize(). initialize() forgets them all without freeing. Copies are shallow: clear the pointers of one of both. Set a pointer to
 * NULL to keep what it pointed to. The arrays of the input are never written.
 *
 * Errors: ints are thrown: 1 out of memory, 2 a bug in the library (please report it), 3 the input intersects itself, 4 a feature is too
 * small to be represented, 5 two facets are too close, 10 the input or a switch is invalid or not supported, 200 -YY cannot be satisfied.
 * Nothing is printed except what V asks for, on stdout, and why a reader failed, on stderr.
 *
 * Threads: different objects may be used by different threads at the same time.
 */
#ifndef DELOTET_TETGEN_H
#define DELOTET_TETGEN_H

/* Programs often use these without including them. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#ifndef DELOTET_TETGEN_VERSION
#define DELOTET_TETGEN_VERSION 150
#endif
#if DELOTET_TETGEN_VERSION != 150 && DELOTET_TETGEN_VERSION != 160
#error "DELOTET_TETGEN_VERSION must be 150 or 160"
#endif

#ifndef REAL
#define REAL double
#endif

/* The functions of the two layouts have the same C++ names, so those of 1.6.0 get names of their own in object files. Those of 1.5.0 have
 * TetGen's, also where a parameter is const here and is not there. */
#ifdef __GNUC__
#define DELOTET_TETGEN_TEXT_(text) #text
#define DELOTET_TETGEN_TEXT(text) DELOTET_TETGEN_TEXT_(text)
#define DELOTET_TETGEN_LABEL(name) __asm__(DELOTET_TETGEN_TEXT(__USER_LABEL_PREFIX__) #name)
#else
#define DELOTET_TETGEN_LABEL(name)
#endif
#if DELOTET_TETGEN_VERSION == 150
#define DELOTET_TETGEN_SYMBOL(name)
#define DELOTET_TETGEN_METHOD(name, mangled) DELOTET_TETGEN_LABEL(_ZN8tetgenio##mangled)
#define DELOTET_TETGEN_INLINE inline
#elif defined(__GNUC__)
#define DELOTET_TETGEN_SYMBOL(name) DELOTET_TETGEN_LABEL(delotet_tetgen160_##name)
#define DELOTET_TETGEN_METHOD(name, mangled) DELOTET_TETGEN_SYMBOL(name)
#define DELOTET_TETGEN_INLINE inline __attribute__((always_inline))
#else
#error "the layout of TetGen 1.6.0 needs GCC or Clang"
#endif

#ifndef DELOTET_TETGEN_RECORDS
#define DELOTET_TETGEN_RECORDS
/* What arrays of tetgenio consist of; known as tetgenio::polygon and so on. The constructors serve `new tetgenio::facet[n]`. */
struct delotet_tetgen_polygon {
    int *vertexlist;
    int numberofvertices;
    delotet_tetgen_polygon() : vertexlist(NULL), numberofvertices(0) {}
};

struct delotet_tetgen_facet {
    delotet_tetgen_polygon *polygonlist;
    int numberofpolygons;
    double *holelist; /* 3 coordinates a hole */
    int numberofholes;
    delotet_tetgen_facet() : polygonlist(NULL), numberofpolygons(0), holelist(NULL), numberofholes(0) {}
};

/* An edge of the Voronoi diagram; v2 is -1 for a ray, which has the direction vnormal. */
struct delotet_tetgen_voroedge {
    int v1, v2;
    double vnormal[3];
};

/* A facet of the Voronoi diagram between two cells; elist[0] is the number of its edges, which follow; -1 closes an unbounded one. */
struct delotet_tetgen_vorofacet {
    int c1, c2;
    int *elist;
};

struct delotet_tetgen_pointparam {
    double uv[2];
    int tag, type;
};

class tetgenmesh; /* Only its name is known. */

/* Throws `code`. */
inline void terminatetetgen(tetgenmesh *, int code)
{
    throw code;
}
#endif

/* Input and output of tetrahedralize(). Indices start at `firstnumber`. */
class tetgenio {
  public:
    typedef delotet_tetgen_polygon polygon;
    typedef delotet_tetgen_facet facet;
    typedef delotet_tetgen_voroedge voroedge;
    typedef delotet_tetgen_vorofacet vorofacet;
    typedef delotet_tetgen_pointparam pointparam;

    /* Callbacks for curved geometry; they are never called. */
    typedef double (*GetVertexParamOnEdge)(void *, int, int);
    typedef void (*GetSteinerOnEdge)(void *, int, double, double *);
    typedef void (*GetVertexParamOnFace)(void *, int, int, double *);
    typedef void (*GetEdgeSteinerParamOnFace)(void *, int, double, int, double *);
    typedef void (*GetSteinerOnFace)(void *, int, double *, double *);
    /* Four corners, the lengths of the six edges and the volume: whether the tetrahedron is to be split. */
    typedef bool (*TetSizeFunc)(double *, double *, double *, double *, double *, double);

    int firstnumber; /* 0 or 1 */
    int mesh_dim;    /* 3 */
    int useindex;

    double *pointlist;          /* 3 coordinates a point */
    double *pointattributelist; /* numberofpointattributes a point */
    double *pointmtrlist;       /* numberofpointmtrs a point: 1, 3 or 6 */
    int *pointmarkerlist;       /* or NULL */
#if DELOTET_TETGEN_VERSION >= 160
    int *point2tetlist; /* out: a tetrahedron of each point */
#endif
    pointparam *pointparamlist;
    int numberofpoints;
    int numberofpointattributes;
    int numberofpointmtrs;

    int *tetrahedronlist;             /* numberofcorners a tetrahedron: 4 or 10 */
    double *tetrahedronattributelist; /* numberoftetrahedronattributes a tetrahedron; its region is the last */
    double *tetrahedronvolumelist;    /* in: the largest volume, or not positive */
    int *neighborlist;                /* out: 4 a tetrahedron, across from its corners; -1 outside */
#if DELOTET_TETGEN_VERSION >= 160
    int *tet2facelist; /* out: 4 a tetrahedron */
    int *tet2edgelist; /* out: 6 a tetrahedron */
#endif
    int numberoftetrahedra;
    int numberofcorners;
    int numberoftetrahedronattributes;

    facet *facetlist;
    int *facetmarkerlist; /* or NULL */
    int numberoffacets;

    double *holelist; /* 3 coordinates a hole */
    int numberofholes;

    double *regionlist; /* 5 a region: a point in it, its attribute, its largest volume (or not positive) */
    int numberofregions;

#if DELOTET_TETGEN_VERSION >= 160
    int *refine_elem_list; /* in: 4 corners a tetrahedron to be refined */
    double *refine_elem_vol_list;
    int numberofrefineelems;
#endif

    double *facetconstraintlist; /* 2 each: facet marker, largest area */
    int numberoffacetconstraints;

    double *segmentconstraintlist; /* 3 each: both ends, largest length */
    int numberofsegmentconstraints;

    int *trifacelist;       /* 3 corners a face */
    int *trifacemarkerlist; /* or NULL */
    int *o2facelist;        /* out, second order: 3 nodes a face */
    union {                 /* out: 2 tetrahedra a face; -1 outside */
        int *face2tetlist;
        int *adjtetlist;
    };
#if DELOTET_TETGEN_VERSION >= 160
    int *face2edgelist; /* out: 3 edges a face */
#endif
    int numberoftrifaces;

    int *edgelist;       /* 2 ends an edge */
    int *edgemarkerlist; /* or NULL */
    int *o2edgelist;     /* out, second order: 1 node an edge */
    union {              /* out: a tetrahedron of each edge */
        int *edge2tetlist;
        int *edgeadjtetlist;
    };
    int numberofedges;

    double *vpointlist; /* out: the Voronoi diagram */
    voroedge *vedgelist;
    vorofacet *vfacetlist;
    int **vcelllist; /* the number of facets of each cell, then the facets */
    int numberofvpoints;
    int numberofvedges;
    int numberofvfacets;
    int numberofvcells;

    void *geomhandle;
    GetVertexParamOnEdge getvertexparamonedge;
    GetSteinerOnEdge getsteineronedge;
    GetVertexParamOnFace getvertexparamonface;
    GetEdgeSteinerParamOnFace getedgesteinerparamonface;
    GetSteinerOnFace getsteineronface;
    TetSizeFunc tetunsuitable;

    /* Readers. The name of a file is given without its extension; they return whether it was read, and say why not on stderr. */
    bool load_node(const char *filebasename) DELOTET_TETGEN_METHOD(load_node, 9load_nodeEPc);
    bool load_edge(const char *filebasename) DELOTET_TETGEN_METHOD(load_edge, 9load_edgeEPc);
    bool load_face(const char *filebasename) DELOTET_TETGEN_METHOD(load_face, 9load_faceEPc);
    bool load_tet(const char *filebasename) DELOTET_TETGEN_METHOD(load_tet, 8load_tetEPc);
    bool load_vol(const char *filebasename) DELOTET_TETGEN_METHOD(load_vol, 8load_volEPc);
    bool load_var(const char *filebasename) DELOTET_TETGEN_METHOD(load_var, 8load_varEPc);
    bool load_mtr(const char *filebasename) DELOTET_TETGEN_METHOD(load_mtr, 8load_mtrEPc);
    bool load_poly(const char *filebasename) DELOTET_TETGEN_METHOD(load_poly, 9load_polyEPc);
    bool load_off(const char *filebasename) DELOTET_TETGEN_METHOD(load_off, 8load_offEPc);
    bool load_ply(const char *filebasename) DELOTET_TETGEN_METHOD(load_ply, 8load_plyEPc);
    bool load_stl(const char *filebasename) DELOTET_TETGEN_METHOD(load_stl, 8load_stlEPc);
    bool load_vtk(const char *filebasename) DELOTET_TETGEN_METHOD(load_vtk, 8load_vtkEPc);
    bool load_medit(const char *filebasename, int istetmesh) DELOTET_TETGEN_METHOD(load_medit, 10load_meditEPci);
    bool load_plc(const char *filebasename, int object) DELOTET_TETGEN_METHOD(load_plc, 8load_plcEPci);
    bool load_tetmesh(const char *filebasename, int object) DELOTET_TETGEN_METHOD(load_tetmesh, 12load_tetmeshEPci);

    /* Writers, of what the object has. */
    void save_nodes(const char *filebasename) DELOTET_TETGEN_METHOD(save_nodes, 10save_nodesEPc);
    void save_elements(const char *filebasename) DELOTET_TETGEN_METHOD(save_elements, 13save_elementsEPc);
    void save_faces(const char *filebasename) DELOTET_TETGEN_METHOD(save_faces, 10save_facesEPc);
    void save_edges(const char *filebasename) DELOTET_TETGEN_METHOD(save_edges, 10save_edgesEPc);
    void save_neighbors(const char *filebasename) DELOTET_TETGEN_METHOD(save_neighbors, 14save_neighborsEPc);
    void save_poly(const char *filebasename) DELOTET_TETGEN_METHOD(save_poly, 9save_polyEPc);
    void save_faces2smesh(const char *filebasename) DELOTET_TETGEN_METHOD(save_faces2smesh, 16save_faces2smeshEPc);

    static void init(polygon *p)
    {
        p->vertexlist = NULL;
        p->numberofvertices = 0;
    }

    static void init(facet *f)
    {
        f->polygonlist = NULL;
        f->numberofpolygons = 0;
        f->holelist = NULL;
        f->numberofholes = 0;
    }

    /* Empties the object and forgets its arrays without freeing them. */
    inline void initialize() DELOTET_TETGEN_SYMBOL(initialize);
    /* Frees the arrays and empties the object. */
    inline void clean_memory() DELOTET_TETGEN_SYMBOL(clean_memory);
    inline void deinitialize() DELOTET_TETGEN_SYMBOL(deinitialize);

    DELOTET_TETGEN_INLINE tetgenio() { initialize(); }
    DELOTET_TETGEN_INLINE ~tetgenio() { clean_memory(); }
};

inline void tetgenio::initialize()
{
    firstnumber = 0;
    mesh_dim = 3;
    useindex = 1;
    pointlist = NULL;
    pointattributelist = NULL;
    pointmtrlist = NULL;
    pointmarkerlist = NULL;
    pointparamlist = NULL;
    numberofpoints = 0;
    numberofpointattributes = 0;
    numberofpointmtrs = 0;
    tetrahedronlist = NULL;
    tetrahedronattributelist = NULL;
    tetrahedronvolumelist = NULL;
    neighborlist = NULL;
    numberoftetrahedra = 0;
    numberofcorners = 4;
    numberoftetrahedronattributes = 0;
    facetlist = NULL;
    facetmarkerlist = NULL;
    numberoffacets = 0;
    holelist = NULL;
    numberofholes = 0;
    regionlist = NULL;
    numberofregions = 0;
    facetconstraintlist = NULL;
    numberoffacetconstraints = 0;
    segmentconstraintlist = NULL;
    numberofsegmentconstraints = 0;
    trifacelist = NULL;
    trifacemarkerlist = NULL;
    o2facelist = NULL;
    face2tetlist = NULL;
    numberoftrifaces = 0;
    edgelist = NULL;
    edgemarkerlist = NULL;
    o2edgelist = NULL;
    edge2tetlist = NULL;
    numberofedges = 0;
    vpointlist = NULL;
    vedgelist = NULL;
    vfacetlist = NULL;
    vcelllist = NULL;
    numberofvpoints = 0;
    numberofvedges = 0;
    numberofvfacets = 0;
    numberofvcells = 0;
    geomhandle = NULL;
    getvertexparamonedge = NULL;
    getsteineronedge = NULL;
    getvertexparamonface = NULL;
    getedgesteinerparamonface = NULL;
    getsteineronface = NULL;
    tetunsuitable = NULL;
#if DELOTET_TETGEN_VERSION >= 160
    point2tetlist = NULL;
    tet2facelist = NULL;
    tet2edgelist = NULL;
    refine_elem_list = NULL;
    refine_elem_vol_list = NULL;
    numberofrefineelems = 0;
    face2edgelist = NULL;
#endif
}

inline void tetgenio::clean_memory()
{
    delete[] pointlist;
    delete[] pointattributelist;
    delete[] pointmtrlist;
    delete[] pointmarkerlist;
    delete[] pointparamlist;
    delete[] tetrahedronlist;
    delete[] tetrahedronattributelist;
    delete[] tetrahedronvolumelist;
    delete[] neighborlist;
    if (facetlist != NULL) {
        for (int i = 0; i < numberoffacets; i++) {
            facet *f = &facetlist[i];
            if (f->polygonlist != NULL) {
                for (int j = 0; j < f->numberofpolygons; j++)
                    delete[] f->polygonlist[j].vertexlist;
                delete[] f->polygonlist;
            }
            delete[] f->holelist;
        }
        delete[] facetlist;
    }
    delete[] facetmarkerlist;
    delete[] holelist;
    delete[] regionlist;
    delete[] facetconstraintlist;
    delete[] segmentconstraintlist;
    delete[] trifacelist;
    delete[] trifacemarkerlist;
    delete[] o2facelist;
    delete[] face2tetlist;
    delete[] edgelist;
    delete[] edgemarkerlist;
    delete[] o2edgelist;
    delete[] edge2tetlist;
    delete[] vpointlist;
    delete[] vedgelist;
    if (vfacetlist != NULL) {
        for (int i = 0; i < numberofvfacets; i++)
            delete[] vfacetlist[i].elist;
        delete[] vfacetlist;
    }
    if (vcelllist != NULL) {
        for (int i = 0; i < numberofvcells; i++)
            delete[] vcelllist[i];
        delete[] vcelllist;
    }
#if DELOTET_TETGEN_VERSION >= 160
    delete[] point2tetlist;
    delete[] tet2facelist;
    delete[] tet2edgelist;
    delete[] refine_elem_list;
    delete[] refine_elem_vol_list;
    delete[] face2edgelist;
#endif
    initialize();
}

inline void tetgenio::deinitialize()
{
    clean_memory();
}

/* The switches, as src/doc/tetgen.md lists them. */
class tetgenbehavior {
  public:
    enum objecttype {
        NODES,
        POLY,
        OFF,
        PLY,
        STL,
        MEDIT,
        VTK,
        MESH
#if DELOTET_TETGEN_VERSION >= 160
        ,
        NEU_MESH
#endif
    };

    int plc;     /* p */
    int psc;     /* s in 1.5 */
    int refine;  /* r */
    int quality; /* q */
    int nobisect; /* Y */
#if DELOTET_TETGEN_VERSION >= 160
    int cdt;       /* D */
    int cdtrefine; /* D# */
#endif
    int coarsen;      /* R */
    int weighted;     /* w */
    int brio_hilbert; /* b */
#if DELOTET_TETGEN_VERSION < 160
    int incrflip; /* l */
#endif
    int flipinsert;   /* L */
    int metric;       /* m */
    int varvolume;    /* a */
    int fixedvolume;  /* a# */
    int regionattrib; /* A */
#if DELOTET_TETGEN_VERSION < 160
    int conforming; /* D */
#endif
    int insertaddpoints; /* i */
    int diagnose;        /* d */
    int convex;          /* c */
    int nomergefacet;    /* M */
    int nomergevertex;   /* M0/1 */
    int noexact;         /* X */
    int nostaticfilter;  /* X1 */
    int zeroindex;       /* z */
    int facesout;        /* f */
    int edgesout;        /* e */
    int neighout;        /* n */
    int voroout;         /* v */
    int meditview;       /* g */
    int vtkview;         /* k */
#if DELOTET_TETGEN_VERSION >= 160
    int vtksurfview; /* k2 */
#endif
    int nobound;        /* B */
    int nonodewritten;  /* N */
    int noelewritten;   /* E */
    int nofacewritten;  /* F */
    int noiterationnum; /* I */
    int nojettison;     /* J */
#if DELOTET_TETGEN_VERSION < 160
    int reversetetori; /* z1 */
#endif
    int docheck; /* C */
    int quiet;   /* Q */
#if DELOTET_TETGEN_VERSION >= 160
    int nowarning; /* W */
#endif
    int verbose; /* V */

    int vertexperblock; /* x */
    int tetrahedraperblock;
    int shellfaceperblock;
#if DELOTET_TETGEN_VERSION < 160
    union { /* Y/# */
        int nobisect_param;
        int supsteiner_level;
    };
#else
    union {
        int supsteiner_level;
        int nobisect_param;
    };
#endif
    int addsteiner_algo; /* Y//# */
    int coarsen_param;   /* R# */
    int weighted_param;  /* w# */
    int fliplinklevel;
    int flipstarsize;
    int fliplinklevelinc;
#if DELOTET_TETGEN_VERSION < 160
    int reflevel;        /* D# */
    int optlevel;        /* O# */
    int optscheme;       /* O/# */
    int delmaxfliplevel;
    int order; /* o# */
#else
    union { /* O# */
        int opt_max_flip_level;
        int optlevel;
    };
    union { /* O/# */
        int opt_scheme;
        int optscheme;
    };
    int opt_iterations;   /* O//# */
    int smooth_cirterion; /* s# */
    int smooth_maxiter;   /* s/# */
    int delmaxfliplevel;
    int order;         /* o# */
    int reversetetori; /* z1 */
#endif
    int steinerleft; /* S# */
#if DELOTET_TETGEN_VERSION >= 160
    int unflip_queue_limit;
#endif
    int no_sort;        /* b */
    int hilbert_order;  /* b///# */
    int hilbert_limit;  /* b//# */
    int brio_threshold; /* b# */
    double brio_ratio;  /* b/# */
#if DELOTET_TETGEN_VERSION < 160
    union { /* p# */
        double facet_ang_tol;
        double facet_separate_ang_tol;
    };
    double maxvolume;     /* a# */
    double minratio;      /* q# */
    double mindihedral;   /* q/# */
    double optmaxdihedral; /* o/# */
    double optminsmtdihed;
    double optminslidihed;
    double epsilon; /* T# */
    double minedgelength;
    double coarsen_percent; /* R/# */
#else
    double epsilon; /* T# */
    union {         /* p# */
        double facet_separate_ang_tol;
        double facet_ang_tol;
    };
    double collinear_ang_tol;   /* p///# */
    double facet_small_ang_tol; /* p//# */
    double maxvolume;           /* a# */
    double maxvolume_length;
    double minratio;           /* q# */
    double opt_max_asp_ratio;  /* o//# */
    double opt_max_edge_ratio; /* o///# */
    double mindihedral;        /* q/# */
    double optmaxdihedral;     /* o/# */
    double metric_scale;       /* m# */
    double smooth_alpha;       /* s//# */
    double coarsen_percent;    /* R/# */
    double elem_growth_ratio;  /* r# */
    double refine_progress_ratio; /* r/# */
#endif

    char commandline[1024];
    char infilename[1024];
    char outfilename[1024];
    char addinfilename[1024];
    char bgmeshfilename[1024];
#if DELOTET_TETGEN_VERSION >= 160
    int hole_mesh; /* H */
    char hole_mesh_filename[1024];
#endif
    enum objecttype object;

    /* Reads switches: as the arguments of a program (the first is its name; one without a leading '-' is the input's name), or as one
     * word, where the '-' is optional; that is also read where argc is 0, from argv[0]. Returns whether they are valid, and says why not
     * on stderr; h prints the list of switches on stdout. */
    bool parse_commandline(int argc, char **argv) DELOTET_TETGEN_SYMBOL(parse_arguments);
    inline bool parse_commandline(char *switches) DELOTET_TETGEN_SYMBOL(parse_switches);

    /* Print the list of switches, and the manual page. */
    void syntax() DELOTET_TETGEN_SYMBOL(syntax);
    void usage() DELOTET_TETGEN_SYMBOL(usage);

    /* The default of each switch. */
    inline void initialize() DELOTET_TETGEN_SYMBOL(defaults);

    DELOTET_TETGEN_INLINE tetgenbehavior() { initialize(); }
};

inline void tetgenbehavior::initialize()
{
    memset(static_cast<void *>(this), 0, sizeof(*this));
    vertexperblock = 4092;
    tetrahedraperblock = 8188;
    shellfaceperblock = 4092;
    nobisect_param = 2;
    addsteiner_algo = 1;
    fliplinklevel = -1;
    flipstarsize = -1;
    fliplinklevelinc = 1;
    delmaxfliplevel = 1;
    order = 1;
    steinerleft = -1;
    hilbert_order = 52;
    hilbert_limit = 8;
    brio_hilbert = 1;
    brio_threshold = 64;
    brio_ratio = 0.125;
    facet_ang_tol = 179.9;
    maxvolume = -1.0;
    epsilon = 1.0e-8;
    minratio = 2.0;
    coarsen_percent = 1.0;
    optlevel = 2;
    optscheme = 7;
#if DELOTET_TETGEN_VERSION < 160
    reflevel = 3;
    mindihedral = 0.0;
    optmaxdihedral = 165.0;
    optminsmtdihed = 179.0;
    optminslidihed = 179.0;
#else
    cdtrefine = 7;
    optlevel = 3;
    opt_iterations = 3;
    smooth_cirterion = 3;
    smooth_maxiter = 7;
    unflip_queue_limit = 1000;
    collinear_ang_tol = 179.9;
    facet_small_ang_tol = 15.0;
    maxvolume_length = -1.0;
    opt_max_asp_ratio = 1000.0;
    opt_max_edge_ratio = 100.0;
    mindihedral = 3.5;
    optmaxdihedral = 177.0;
    metric_scale = 1.0;
    smooth_alpha = 0.3;
    refine_progress_ratio = 0.333;
#endif
    object = NODES;
}

inline bool tetgenbehavior::parse_commandline(char *switches)
{
    return parse_commandline(0, &switches);
}

/* Makes a tetrahedral mesh of `in`, with the points of `addin` (i) and sizes from the mesh `bgmin` (m), each of which may be NULL. `out` is
 * filled, or with NULL files are written. Returns 0. `switches` are read only. */
int tetrahedralize(tetgenbehavior *b, tetgenio *in, tetgenio *out, tetgenio *addin = NULL,
                   tetgenio *bgmin = NULL) DELOTET_TETGEN_SYMBOL(tetrahedralize);
int tetrahedralize(char *switches, tetgenio *in, tetgenio *out, tetgenio *addin = NULL,
                   tetgenio *bgmin = NULL) DELOTET_TETGEN_SYMBOL(tetrahedralize_switches);

#endif /* DELOTET_TETGEN_H */
