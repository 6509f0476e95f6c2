/* delotet: exact constrained Delaunay tetrahedralization. C API. MIT OR Apache-2.0.
 *
 * Generated from src/ffi by capi-tests/header.rs. Do not edit: run UPDATE_HEADER=1 cargo test --test header.
 *
 * Objects: DelotetPlc is the input, DelotetOptions the settings, DelotetMesh the result, DelotetError a failure. Whoever receives one
 * through an out-parameter or from a _new function owns it and frees it with the _free function of its type, which ignores NULL.
 *
 * Failures: every function that can fail returns a DelotetStatus, 0 on success. If its last argument `out_error` is not NULL, it
 * receives NULL on success and an owned DelotetError on failure, with a message and all elements at fault. Results are written only on
 * success; handles in out-parameters are NULL on failure.
 *
 * Arrays: input arrays are read during the call and copied; (NULL, 0) is the empty array. Output arrays are views: a pointer into the
 * object and a count, without a copy, valid until the object is freed. Rows are contiguous; "#points by 3" means 3 numbers per point.
 * Indices are 0-based uint32_t; DELOTET_INVALID_INDEX means none. Views of records (DelotetSubfacesView, for instance) also have a stride:
 * later versions may append fields to a record, so step from one to the next by `stride`, not by sizeof. DELOTET_AT does that:
 *
 *     DelotetSubfacesView faces = delotet_mesh_subfaces(mesh);
 *     for (size_t i = 0; i < faces.count; i++) {
 *         const DelotetSubface *face = DELOTET_AT(DelotetSubface, faces, i);
 *         ...
 *     }
 *
 * Threads: functions may be called from any thread. Functions that take const handles may run concurrently on the same handle;
 * functions that take non-const handles need exclusive access to them. Distinct handles share nothing. There is no global state visible to
 * callers.
 *
 * Environment: the calling thread must be in round-to-nearest mode. The library prints nothing, handles no signals and reads no locale.
 * Callbacks must not throw C++ exceptions through the library (delotet.hpp takes care of that), must not longjmp, and must not use the
 * handles of the call.
 */

#ifndef DELOTET_DELOTET_H
#define DELOTET_DELOTET_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
/** Version of this header. */
#define DELOTET_VERSION_MAJOR 0
#define DELOTET_VERSION_MINOR 2
#define DELOTET_VERSION_PATCH 0
/** 1,000,000 * major + 1,000 * minor + patch: compare with delotet_version(). */
#define DELOTET_VERSION 2000
#define DELOTET_VERSION_STRING "0.2.0"

/* Define DELOTET_SHARED when linking the shared library on Windows; the CMake package does. */
#if defined(_WIN32) && defined(DELOTET_SHARED)
#define DELOTET_API __declspec(dllimport)
#else
#define DELOTET_API
#endif

#if defined(__GNUC__) || defined(__clang__)
#define DELOTET_MUST_USE __attribute__((warn_unused_result))
#define DELOTET_DEPRECATED(note) __attribute__((deprecated(note)))
#else
#define DELOTET_MUST_USE
#define DELOTET_DEPRECATED(note)
#endif

/** The index that means "none": no neighbour, no parent, not found. Valid indices are smaller. */
#define DELOTET_INVALID_INDEX UINT32_C(4294967295)

/**
 * Pointer to record `i` of a view, a `const Type *`. The compiler complains if `Type` is not the type of the view's records.
 * Evaluates `view` more than once.
 */
#define DELOTET_AT(Type, view, i)                                                                            \
    (1 ? (const Type *)(const void *)((const char *)(view).first + (size_t)(i) * (view).stride) : (view).first)

/**
 * The number of measures.
 */
#define DELOTET_QUALITY_MEASURES 4

/**
 * The number of bins of each histogram.
 */
#define DELOTET_QUALITY_BINS 10

/**
 * Tetrahedra in wedges of fewer degrees are input-forced (delotet_mesh_forced_tets()).
 */
#define DELOTET_QUALITY_FORCED_BELOW 30.0

/**
 * Outcome of a call. Groups: 0 success; 1-9 the caller; 10-29 the input's geometry; 30-39 cancelled, or impossible within the caller's
 * limits; 40-49 resources; 50-59 files; 60-69 checks; 90 a bug in the library.
 */
typedef enum DelotetStatus {
    /**
     * Success.
     */
    DELOTET_STATUS_OK = 0,
    /**
     * An argument is NULL where that is not allowed, or is outside its documented range.
     */
    DELOTET_STATUS_INVALID_ARGUMENT = 1,
    /**
     * Well-formed, but not supported: an unknown file format, a combination of options.
     */
    DELOTET_STATUS_UNSUPPORTED = 2,
    /**
     * A coordinate is NaN or infinite.
     */
    DELOTET_STATUS_NON_FINITE_POINT = 10,
    /**
     * The coordinates span more binary orders of magnitude than exact arithmetic in doubles can handle.
     */
    DELOTET_STATUS_COORDINATE_RANGE = 11,
    /**
     * An element refers to a point that does not exist.
     */
    DELOTET_STATUS_INDEX_OUT_OF_RANGE = 12,
    /**
     * A facet or segment has no extent, or a ring is not a usable polygon.
     */
    DELOTET_STATUS_DEGENERATE_FACET = 14,
    /**
     * A polygon is too far from planar to be triangulated without crossing itself.
     */
    DELOTET_STATUS_NON_PLANAR_FACET = 15,
    /**
     * Elements of the PLC cross or overlap outside their common points and edges.
     */
    DELOTET_STATUS_SELF_INTERSECTION = 16,
    /**
     * All points lie in one plane: there is no tetrahedron.
     */
    DELOTET_STATUS_DEGENERATE_INPUT = 17,
    /**
     * A region seed lies outside the domain, or a region or hole seed lies on a facet.
     */
    DELOTET_STATUS_SEED_OUTSIDE = 18,
    /**
     * The surface encloses nothing, and the convex hull was not requested.
     */
    DELOTET_STATUS_NOTHING_ENCLOSED = 19,
    /**
     * The caller asked to stop, by its callback or its token.
     */
    DELOTET_STATUS_CANCELLED = 30,
    /**
     * The caller's limit on Steiner points was reached.
     */
    DELOTET_STATUS_STEINER_LIMIT = 31,
    /**
     * The exact mesh exists, but some Steiner points have no valid position in doubles: elements are too close to each other.
     */
    DELOTET_STATUS_ROUNDING = 33,
    /**
     * The caller's limit on time was reached.
     */
    DELOTET_STATUS_TIME_LIMIT = 34,
    /**
     * The caller's limit on memory was reached.
     */
    DELOTET_STATUS_MEMORY_LIMIT = 35,
    /**
     * The caller's limit on tetrahedra was reached.
     */
    DELOTET_STATUS_TETRAHEDRA_LIMIT = 36,
    /**
     * Memory ran out.
     */
    DELOTET_STATUS_OUT_OF_MEMORY = 40,
    /**
     * More elements than 32-bit indices can address.
     */
    DELOTET_STATUS_TOO_LARGE = 41,
    /**
     * A file cannot be opened, read or written.
     */
    DELOTET_STATUS_FILE = 50,
    /**
     * The content of a file does not follow its format.
     */
    DELOTET_STATUS_FORMAT = 51,
    /**
     * A mesh failed its check.
     */
    DELOTET_STATUS_CHECK_FAILED = 60,
    /**
     * An invariant failed: a bug in the library, please report it. Any handle that the call was modifying may only be freed.
     */
    DELOTET_STATUS_INTERNAL = 90,
} DelotetStatus;

/**
 * Stages of a run. The numbers are fixed. The stages run in this order, except that DELOTET_PHASE_PRESERVE and DELOTET_PHASE_REFINE come
 * before DELOTET_PHASE_ROUND, and DELOTET_PHASE_OPTIMIZE before DELOTET_PHASE_AUDIT.
 */
typedef enum DelotetPhase {
    /**
     * Reading a file.
     */
    DELOTET_PHASE_READ = 0,
    /**
     * Checking the input.
     */
    DELOTET_PHASE_VALIDATE = 1,
    /**
     * Delaunay tetrahedralization of the points.
     */
    DELOTET_PHASE_DELAUNAY = 2,
    /**
     * Segment recovery.
     */
    DELOTET_PHASE_SEGMENTS = 3,
    /**
     * Facet recovery.
     */
    DELOTET_PHASE_FACETS = 4,
    /**
     * Carving, holes and regions.
     */
    DELOTET_PHASE_REGIONS = 5,
    /**
     * Rounding Steiner points to doubles.
     */
    DELOTET_PHASE_ROUND = 6,
    /**
     * The exact audit of the result.
     */
    DELOTET_PHASE_AUDIT = 7,
    /**
     * Writing files.
     */
    DELOTET_PHASE_WRITE = 8,
    /**
     * Keeping the surface as it is (DELOTET_MODE_PRESERVE).
     */
    DELOTET_PHASE_PRESERVE = 9,
    /**
     * Points by size and shape (delotet_options_set_size(), delotet_options_set_quality()).
     */
    DELOTET_PHASE_REFINE = 10,
    /**
     * Optimisation (delotet_options_set_optimize()).
     */
    DELOTET_PHASE_OPTIMIZE = 11,
} DelotetPhase;

/**
 * What kind of element an index refers to.
 */
typedef enum DelotetElement {
    /**
     * No element.
     */
    DELOTET_ELEMENT_NONE = 0,
    /**
     * An input point (in a check of a mesh: a point of the mesh).
     */
    DELOTET_ELEMENT_POINT = 1,
    /**
     * An input segment, in the order of addition.
     */
    DELOTET_ELEMENT_SEGMENT = 2,
    /**
     * An input facet, in the order of addition.
     */
    DELOTET_ELEMENT_FACET = 3,
    /**
     * A hole seed.
     */
    DELOTET_ELEMENT_HOLE = 4,
    /**
     * A region seed.
     */
    DELOTET_ELEMENT_REGION = 5,
    /**
     * A tetrahedron of the mesh.
     */
    DELOTET_ELEMENT_TET = 6,
} DelotetElement;

/**
 * What kind of defect was found.
 */
typedef enum DelotetDefectKind {
    /**
     * A coordinate is NaN or infinite.
     */
    DELOTET_DEFECT_KIND_NON_FINITE = 1,
    /**
     * A coordinate cannot be scaled into the exact range.
     */
    DELOTET_DEFECT_KIND_COORDINATE_RANGE = 2,
    /**
     * An index refers to no element.
     */
    DELOTET_DEFECT_KIND_INDEX_OUT_OF_RANGE = 3,
    /**
     * A segment joins a point with itself or with an equal one.
     */
    DELOTET_DEFECT_KIND_DEGENERATE_SEGMENT = 4,
    /**
     * A facet has no area, fewer than three distinct corners, or a ring that is not a polygon.
     */
    DELOTET_DEFECT_KIND_DEGENERATE_FACET = 5,
    /**
     * A ring of a facet touches or crosses itself or another ring of the facet.
     */
    DELOTET_DEFECT_KIND_RING_INTERSECTION = 6,
    /**
     * An inner ring lies outside the outer one, or inside another inner ring.
     */
    DELOTET_DEFECT_KIND_RING_NESTING = 7,
    /**
     * A polygon cannot be triangulated: its projection onto a plane folds over itself.
     */
    DELOTET_DEFECT_KIND_NON_PLANAR_FACET = 8,
    /**
     * Two facets cover the same triangle.
     */
    DELOTET_DEFECT_KIND_DUPLICATE_FACET = 9,
    /**
     * Two segments cross at an inner point of both.
     */
    DELOTET_DEFECT_KIND_SEGMENT_SEGMENT = 10,
    /**
     * A segment (or an edge of a facet) pierces a facet.
     */
    DELOTET_DEFECT_KIND_SEGMENT_FACET = 11,
    /**
     * Two facets cross.
     */
    DELOTET_DEFECT_KIND_FACET_FACET = 12,
    /**
     * Two coplanar facets, or a facet and a segment in it, overlap along an area or a line without sharing it.
     */
    DELOTET_DEFECT_KIND_OVERLAP = 13,
    /**
     * A seed lies exactly on a facet.
     */
    DELOTET_DEFECT_KIND_SEED_ON_FACET = 14,
    /**
     * A seed lies outside the domain.
     */
    DELOTET_DEFECT_KIND_SEED_OUTSIDE = 15,
    /**
     * An edge of only one facet, where a surface that encloses nothing leaks. The elements are its ends, the point its midpoint.
     */
    DELOTET_DEFECT_KIND_OPEN_EDGE = 16,
    /**
     * Two elements are too close to each other: a Steiner point needed on the first has no valid position in doubles, and the second is
     * the element nearest to it.
     */
    DELOTET_DEFECT_KIND_ROUNDING = 17,
    /**
     * A tetrahedron is flat (zero volume) or inverted.
     */
    DELOTET_DEFECT_KIND_NOT_POSITIVE = 18,
    /**
     * A face is shared by more than two tetrahedra, or by two on the same side, or a neighbour is wrong.
     */
    DELOTET_DEFECT_KIND_NOT_CONFORMING = 19,
    /**
     * An input point is missing from the mesh or was moved.
     */
    DELOTET_DEFECT_KIND_POINT_MOVED = 20,
    /**
     * A segment is not a union of edges of the mesh.
     */
    DELOTET_DEFECT_KIND_SEGMENT_MISSING = 21,
    /**
     * A facet is not a union of faces of the mesh.
     */
    DELOTET_DEFECT_KIND_FACET_MISSING = 22,
    /**
     * An unconstrained face is not locally Delaunay.
     */
    DELOTET_DEFECT_KIND_NOT_DELAUNAY = 23,
    /**
     * A boundary face of the mesh lies on no facet.
     */
    DELOTET_DEFECT_KIND_HULL_OFF_FACETS = 24,
} DelotetDefectKind;

/**
 * What a warning is about.
 */
typedef enum DelotetWarningKind {
    /**
     * An edge of only one facet, on a part of the surface that encloses nothing: it leaks there. The elements are the ends.
     */
    DELOTET_WARNING_KIND_OPEN_EDGE = 1,
    /**
     * A part of a facet bounds no tetrahedron.
     */
    DELOTET_WARNING_KIND_UNMESHED_FACET = 2,
    /**
     * A part of a segment is an edge of no tetrahedron.
     */
    DELOTET_WARNING_KIND_UNMESHED_SEGMENT = 3,
    /**
     * A point is a corner of no tetrahedron and equals no earlier point.
     */
    DELOTET_WARNING_KIND_UNMESHED_POINT = 4,
    /**
     * A point equals an earlier one, which is used instead. The elements are the point and the earlier one.
     */
    DELOTET_WARNING_KIND_EQUAL_POINTS = 5,
    /**
     * Two region seeds lie in one region; the attribute of the earlier is used. The elements are the later seed and the earlier one.
     */
    DELOTET_WARNING_KIND_REPEATED_SEED = 6,
    /**
     * A hole seed lies outside the domain and has no effect.
     */
    DELOTET_WARNING_KIND_HOLE_OUTSIDE = 7,
    /**
     * A region has a volume bound, which has no effect unless the mesh is filled with points (delotet_options_set_size()).
     */
    DELOTET_WARNING_KIND_UNUSED_VOLUME = 8,
    /**
     * A polygon is out of plane by more than rounding; it was triangulated.
     */
    DELOTET_WARNING_KIND_NON_PLANAR_FACET = 9,
    /**
     * A file's format cannot hold a value as it is.
     */
    DELOTET_WARNING_KIND_LOST_VALUE = 10,
} DelotetWarningKind;

/**
 * Cancels runs from any thread: one token may be given to the options of any number of runs. Functions that take `const` tokens may be
 * called at any time, concurrently with the runs and with each other. Options keep the token alive: it may be freed while they use it.
 */
typedef struct DelotetCancelToken DelotetCancelToken;

/**
 * A failure: its status, a readable message, and all elements at fault. Created by the failing call, owned by the caller.
 */
typedef struct DelotetError DelotetError;

/**
 * A tetrahedral mesh: immutable, so any number of threads may read it.
 */
typedef struct DelotetMesh DelotetMesh;

/**
 * Edge lengths wanted in a mesh that is to be refined: at its points, in its tetrahedra, and by markers and attributes.
 */
typedef struct DelotetMeshSizes DelotetMeshSizes;

/**
 * Settings of a run. One object may serve any number of runs, even concurrent ones (the callbacks are then called from all their threads).
 */
typedef struct DelotetOptions DelotetOptions;

/**
 * A piecewise linear complex: points, segments, facets, hole seeds and region seeds. Indices of points, segments and facets
 * are 0-based, in the order of addition.
 */
typedef struct DelotetPlc DelotetPlc;

/**
 * The tetrahedra of a mesh above a radius-edge ratio: immutable, so any number of threads may read it.
 */
typedef struct DelotetSkinnyTets DelotetSkinnyTets;

/**
 * The Voronoi diagram of the points of a mesh, or their power diagram: immutable, so any number of threads may read it.
 */
typedef struct DelotetVoronoi DelotetVoronoi;

/**
 * How a mesh or a PLC is written. One object may serve any number of calls, even concurrent ones (the log callback is then called
 * from all their threads).
 */
typedef struct DelotetWriteOptions DelotetWriteOptions;

/**
 * One defect: kind, the one or two elements involved, and a point that locates it.
 */
typedef struct DelotetDefect {
    /**
     * The kind: a DelotetDefectKind, stored as 32 bits with every compiler.
     */
    uint32_t kind;
    /**
     * What kind of element `first` is: a DelotetElement.
     */
    uint32_t first_element;
    /**
     * Index of the element at fault.
     */
    uint32_t first;
    /**
     * What kind of element `second` is: a DelotetElement, DELOTET_ELEMENT_NONE if only one element is involved.
     */
    uint32_t second_element;
    /**
     * Index of the other element of a pair, or DELOTET_INVALID_INDEX.
     */
    uint32_t second;
    /**
     * 1 if `point` is set, else 0.
     */
    uint32_t has_point;
    /**
     * x y z of a point at or near the defect (rounded where it is an intersection); zeros if there is none.
     */
    double point[3];
} DelotetDefect;

/**
 * Borrowed defects; NULL and 0 if there are none.
 */
typedef struct DelotetDefectsView {
    /**
     * The first of `count` defects; DELOTET_AT(DelotetDefect, view, i) is the i-th.
     */
    const struct DelotetDefect *first;
    /**
     * Number of elements.
     */
    size_t count;
    /**
     * Bytes from one element to the next.
     */
    size_t stride;
} DelotetDefectsView;

/**
 * What is made from the input: one of the DELOTET_MODE_ constants.
 */
typedef uint32_t DelotetMode;

/**
 * What DELOTET_MODE_PRESERVE keeps: one of the DELOTET_PRESERVE_ constants.
 */
typedef uint32_t DelotetPreserve;

/**
 * Receives progress: `fraction` of `phase` is done, from 0 to 1. Phases come in order, each once and up to 1 (unneeded ones never), and
 * fractions never decrease: repeated attempts report no progress. delotet_phase_overall() combines both into one number. Return 0 to
 * continue, anything else to cancel: the call then fails with DELOTET_STATUS_CANCELLED. Called on the thread that made the call. Must not
 * throw, must not longjmp, and must not use the handles of the call.
 */
typedef int32_t (*DelotetProgressFn)(void *user_data, enum DelotetPhase phase, double fraction);

/**
 * Receives a line of text about the run; warnings begin with "warning: " and come at its end, one line per kind. `message` is UTF-8 and
 * valid only during the callback. Called on the thread that made the call. Must not throw, must not longjmp, and must not use the handles
 * of the call.
 */
typedef void (*DelotetLogFn)(void *user_data, const char *message);

/**
 * Borrowed points; NULL and 0 if there are none.
 */
typedef struct DelotetPointsView {
    /**
     * #points by 3 doubles: x y z per point.
     */
    const double *data;
    /**
     * Number of points.
     */
    size_t count;
} DelotetPointsView;

/**
 * Borrowed rows of doubles; NULL and zeros if there are none.
 */
typedef struct DelotetDoublesView {
    /**
     * #rows by `width` doubles.
     */
    const double *data;
    /**
     * Number of rows.
     */
    size_t count;
    /**
     * Number of doubles per row.
     */
    size_t width;
} DelotetDoublesView;

/**
 * Borrowed markers; NULL and 0 if there are none.
 */
typedef struct DelotetMarkersView {
    /**
     * `count` integers.
     */
    const int32_t *data;
    /**
     * Number of elements.
     */
    size_t count;
} DelotetMarkersView;

/**
 * A segment of the input.
 */
typedef struct DelotetSegment {
    /**
     * The ends.
     */
    uint32_t ends[2];
    /**
     * The marker.
     */
    int32_t marker;
} DelotetSegment;

/**
 * Borrowed segments; NULL and 0 if there are none.
 */
typedef struct DelotetSegmentsView {
    /**
     * The first of `count` segments; DELOTET_AT(DelotetSegment, view, i) is the i-th.
     */
    const struct DelotetSegment *first;
    /**
     * Number of elements.
     */
    size_t count;
    /**
     * Bytes from one element to the next.
     */
    size_t stride;
} DelotetSegmentsView;

/**
 * A region seed of the input.
 */
typedef struct DelotetRegionSeed {
    /**
     * x y z of a point inside the region.
     */
    double point[3];
    /**
     * The attribute of the tetrahedra there.
     */
    double attribute;
    /**
     * Bound on the volume of a tetrahedron there; 0 if there is none.
     */
    double max_volume;
} DelotetRegionSeed;

/**
 * Borrowed region seeds; NULL and 0 if there are none.
 */
typedef struct DelotetRegionSeedsView {
    /**
     * The first of `count` seeds; DELOTET_AT(DelotetRegionSeed, view, i) is the i-th.
     */
    const struct DelotetRegionSeed *first;
    /**
     * Number of elements.
     */
    size_t count;
    /**
     * Bytes from one element to the next.
     */
    size_t stride;
} DelotetRegionSeedsView;

/**
 * Borrowed rows of indices; NULL and zeros if there are none.
 */
typedef struct DelotetIndexRowsView {
    /**
     * #rows by `width` indices.
     */
    const uint32_t *data;
    /**
     * Number of rows.
     */
    size_t count;
    /**
     * Number of indices per row.
     */
    size_t width;
} DelotetIndexRowsView;

/**
 * Borrowed indices; NULL and 0 if there are none.
 */
typedef struct DelotetIndicesView {
    /**
     * `count` indices.
     */
    const uint32_t *data;
    /**
     * Number of elements.
     */
    size_t count;
} DelotetIndicesView;

/**
 * How the rings of a facet bound it: one of the DELOTET_FACET_RULE_ constants.
 */
typedef uint32_t DelotetFacetRule;

/**
 * Gives the edge length wanted at a point. `point`: its x y z, valid only during the callback. `size`: receives the length, positive or
 * infinite; infinite, which it is before the call, is no wish. Return 0 to continue, anything else to cancel: the call then fails with
 * DELOTET_STATUS_CANCELLED; NaN, zero and negative lengths end it with DELOTET_STATUS_INVALID_ARGUMENT. Called on the thread that made
 * the call, once or more for a point, in the same order in every run. The same point must always get the same length: otherwise the mesh
 * is another one in every run. Must not throw, must not longjmp, and must not use the handles of the call.
 */
typedef int32_t (*DelotetSizeFunction)(void *user_data, const double *point, double *size);

/**
 * Borrowed quadruples of indices, one per tetrahedron; NULL and 0 if there are none.
 */
typedef struct DelotetTetsView {
    /**
     * #tetrahedra by 4 indices.
     */
    const uint32_t *data;
    /**
     * Number of tetrahedra.
     */
    size_t count;
} DelotetTetsView;

/**
 * A region of the mesh: tetrahedra that are connected through unconstrained faces and share a seed (or have none).
 */
typedef struct DelotetRegion {
    /**
     * The attribute of the seed; a region without a seed has a number of its own that no seed uses.
     */
    double attribute;
    /**
     * The volume bound of the seed; 0 if it has none.
     */
    double max_volume;
    /**
     * Index of the region seed, or DELOTET_INVALID_INDEX.
     */
    uint32_t seed;
} DelotetRegion;

/**
 * Borrowed regions; NULL and 0 if there are none.
 */
typedef struct DelotetRegionsView {
    /**
     * The first of `count` regions; DELOTET_AT(DelotetRegion, view, i) is the i-th.
     */
    const struct DelotetRegion *first;
    /**
     * Number of elements.
     */
    size_t count;
    /**
     * Bytes from one element to the next.
     */
    size_t stride;
} DelotetRegionsView;

/**
 * A piece of a facet: a triangle that is a face of the mesh.
 */
typedef struct DelotetSubface {
    /**
     * The corners.
     */
    uint32_t corners[3];
    /**
     * The input facet it lies on (one of them, if coplanar neighbours with equal markers are meshed as one facet).
     */
    uint32_t facet;
    /**
     * That facet's marker.
     */
    int32_t marker;
    /**
     * The tetrahedra on both sides: first the one in the region with the lower index or, within one region, the one with the lower index.
     * The second is DELOTET_INVALID_INDEX on the boundary. `(b - a) x (c - a)` points from the first to the second: from the lower region
     * to the higher, and outward on the boundary.
     */
    uint32_t tets[2];
} DelotetSubface;

/**
 * Borrowed subfaces; NULL and 0 if there are none.
 */
typedef struct DelotetSubfacesView {
    /**
     * The first of `count` subfaces; DELOTET_AT(DelotetSubface, view, i) is the i-th.
     */
    const struct DelotetSubface *first;
    /**
     * Number of elements.
     */
    size_t count;
    /**
     * Bytes from one element to the next.
     */
    size_t stride;
} DelotetSubfacesView;

/**
 * A piece of a segment or of a facet edge: an edge of the mesh.
 */
typedef struct DelotetSubsegment {
    /**
     * The ends.
     */
    uint32_t ends[2];
    /**
     * The input segment it lies on, or DELOTET_INVALID_INDEX for a facet edge that is no segment.
     */
    uint32_t segment;
    /**
     * The segment's marker, or 0 if there is no segment.
     */
    int32_t marker;
} DelotetSubsegment;

/**
 * Borrowed subsegments; NULL and 0 if there are none.
 */
typedef struct DelotetSubsegmentsView {
    /**
     * The first of `count` subsegments; DELOTET_AT(DelotetSubsegment, view, i) is the i-th.
     */
    const struct DelotetSubsegment *first;
    /**
     * Number of elements.
     */
    size_t count;
    /**
     * Bytes from one element to the next.
     */
    size_t stride;
} DelotetSubsegmentsView;

/**
 * A Steiner point and where it lies: on an input edge, on an input facet, or inside, exactly at its double coordinates.
 */
typedef struct DelotetSteinerPoint {
    /**
     * Input points a and b, the ends of the input edge; the point lies on it at exactly a + t (b - a). On a facet, two points of its plane:
     * see `third`. Both are DELOTET_INVALID_INDEX for a point inside.
     */
    uint32_t ends[2];
    /**
     * The parameter t; 0 for a point inside. The few parameters that one double cannot hold have further terms in
     * delotet_mesh_steiner_terms().
     */
    double t;
    /**
     * The input segment it lies on, or DELOTET_INVALID_INDEX if the edge belongs to facets only or the point lies on no edge.
     */
    uint32_t segment;
    /**
     * True if its coordinates are its exact position, and for a point inside. False if they were rounded, or moved to keep every
     * tetrahedron positive.
     */
    bool exact;
    /**
     * For a point on a facet, input point c, a third one of its plane: the point lies at exactly a + t (b - a) + u (c - a). There `ends`
     * and `third` are DELOTET_INVALID_INDEX if its coordinates lie in the plane themselves and are its position. DELOTET_INVALID_INDEX
     * elsewhere.
     */
    uint32_t third;
    /**
     * The input facet it lies on (inside, not on an edge), or DELOTET_INVALID_INDEX.
     */
    uint32_t facet;
    /**
     * The second parameter of a point on a facet; 0 elsewhere.
     */
    double u;
} DelotetSteinerPoint;

/**
 * Borrowed Steiner points; NULL and 0 if there are none.
 */
typedef struct DelotetSteinerView {
    /**
     * The first of `count` Steiner points; DELOTET_AT(DelotetSteinerPoint, view, i) is the i-th.
     */
    const struct DelotetSteinerPoint *first;
    /**
     * Number of elements.
     */
    size_t count;
    /**
     * Bytes from one element to the next.
     */
    size_t stride;
} DelotetSteinerView;

/**
 * A further term of a Steiner point's parameter: the exact parameter is the sum of `t` and its terms.
 */
typedef struct DelotetSteinerTerm {
    /**
     * Index into delotet_mesh_steiner_points().
     */
    uint32_t steiner;
    /**
     * The term.
     */
    double value;
} DelotetSteinerTerm;

/**
 * Borrowed terms; NULL and 0 if there are none.
 */
typedef struct DelotetSteinerTermsView {
    /**
     * The first of `count` terms; DELOTET_AT(DelotetSteinerTerm, view, i) is the i-th.
     */
    const struct DelotetSteinerTerm *first;
    /**
     * Number of elements.
     */
    size_t count;
    /**
     * Bytes from one element to the next.
     */
    size_t stride;
} DelotetSteinerTermsView;

/**
 * A flip of two facet triangles, made by facet merging before meshing.
 */
typedef struct DelotetFacetFlip {
    /**
     * The removed edge (input points).
     */
    uint32_t old_ends[2];
    /**
     * The edge that replaces it.
     */
    uint32_t new_ends[2];
    /**
     * The two facets.
     */
    uint32_t facets[2];
} DelotetFacetFlip;

/**
 * Borrowed facet flips; NULL and 0 if there are none.
 */
typedef struct DelotetFacetFlipsView {
    /**
     * The first of `count` flips; DELOTET_AT(DelotetFacetFlip, view, i) is the i-th.
     */
    const struct DelotetFacetFlip *first;
    /**
     * Number of elements.
     */
    size_t count;
    /**
     * Bytes from one element to the next.
     */
    size_t stride;
} DelotetFacetFlipsView;

/**
 * Counts and costs of the run that made a mesh. Later versions append fields; `struct_size` tells both sides which ones exist.
 */
typedef struct DelotetStats {
    /**
     * The caller sets it to sizeof(DelotetStats); the library sets it to the number of bytes written.
     */
    size_t struct_size;
    /**
     * Steiner points on segments and facet edges, without those of refinement.
     */
    uint64_t steiner;
    /**
     * Steiner points on segments, facet edges and facets whose double coordinates are exact, with those of refinement.
     */
    uint64_t steiner_exact;
    /**
     * Steiner points moved to another position because the nearest doubles were not valid.
     */
    uint64_t steiner_moved;
    /**
     * Input points that equal an earlier one.
     */
    uint64_t duplicate_points;
    /**
     * Segments missing from the Delaunay tetrahedralization of the points.
     */
    uint64_t missing_segments;
    /**
     * Missing regions that facet recovery filled.
     */
    uint64_t missing_regions;
    /**
     * Peak size of the engine's arrays in bytes.
     */
    uint64_t peak_bytes;
    /**
     * Seconds per phase, indexed by DelotetPhase; unused entries are 0.
     */
    double seconds[16];
    /**
     * Edges of the surface missing from the Delaunay tetrahedralization of the points. Like all `preserve_` fields, 0 except in
     * DELOTET_MODE_PRESERVE.
     */
    uint64_t preserve_missing_edges;
    /**
     * Triangles of the surface missing from that tetrahedralization.
     */
    uint64_t preserve_missing_faces;
    /**
     * Edges and faces recovered by reconnecting tetrahedra alone.
     */
    uint64_t preserve_by_reconnection;
    /**
     * Edges and faces recovered with the help of points inside.
     */
    uint64_t preserve_by_interior_points;
    /**
     * Edges and faces recovered by points on them that were removed again.
     */
    uint64_t preserve_by_splits;
    /**
     * Points on the surface removed without a replacement.
     */
    uint64_t preserve_deleted;
    /**
     * Points on the surface replaced by points inside.
     */
    uint64_t preserve_relocated;
    /**
     * Points added inside for the surface that remain in the mesh, without those of filling and optimisation.
     */
    uint64_t preserve_interior;
    /**
     * Points left on internal facets and segments (DELOTET_PRESERVE_OUTER).
     */
    uint64_t preserve_on_internal_facets;
    /**
     * Tetrahedra that replace ones for which no double coordinates gave a positive volume (delotet_mesh_replaced_tets()).
     */
    uint64_t replaced;
    /**
     * Peak resident memory of the process up to the end of the run in bytes, including the host program's; 0 if the system does not report
     * it.
     */
    uint64_t peak_resident_bytes;
    /**
     * Points that filling and refinement put on segments and facet edges. Like all `refine_` fields, 0 if nothing was filled.
     */
    uint64_t refine_on_segments;
    /**
     * Points that they put on facets.
     */
    uint64_t refine_on_facets;
    /**
     * Points that they put inside.
     */
    uint64_t refine_inside;
    /**
     * Of these points, how many came for a length, an area or a volume.
     */
    uint64_t refine_for_sizes;
    /**
     * How many came for a radius-edge ratio.
     */
    uint64_t refine_for_shapes;
    /**
     * Places refused since a vertex was too near.
     */
    uint64_t refine_too_near;
    /**
     * Places refused since the tetrahedron between them and the surface would have been too flat.
     */
    uint64_t refine_too_flat;
    /**
     * Places put off since they were in the sphere of a piece of the surface, which came first.
     */
    uint64_t refine_encroaching;
    /**
     * Places refused since a piece of the surface was in the way.
     */
    uint64_t refine_blocked;
    /**
     * Places refused for other reasons.
     */
    uint64_t refine_elsewhere;
    /**
     * Tetrahedra and pieces of facets above the ratio that were left since no more points may come for shapes; 0 if these were enough.
     */
    uint64_t refine_over_budget;
    /**
     * Passes of the optimisation over the bad tetrahedra. Like all `optimize_` fields, 0 if there was none.
     */
    uint64_t optimize_passes;
    /**
     * Moves of points; one may move more than once.
     */
    uint64_t optimize_moves;
    /**
     * Edges removed.
     */
    uint64_t optimize_edges_removed;
    /**
     * Removals of faces, of one or more at a time.
     */
    uint64_t optimize_faces_removed;
    /**
     * Cavities filled anew.
     */
    uint64_t optimize_reconnected;
    /**
     * Points that came.
     */
    uint64_t optimize_points_added;
    /**
     * Points that went into a neighbour.
     */
    uint64_t optimize_points_removed;
    /**
     * The worst dihedral angle before, in degrees: the least of all angles, and of what is missing of them to 180 degrees.
     */
    double optimize_worst_before;
    /**
     * The same after it.
     */
    double optimize_worst_after;
} DelotetStats;

/**
 * One warning: kind, the one or two elements involved, and a point that locates it.
 */
typedef struct DelotetWarning {
    /**
     * The kind: a DelotetWarningKind, stored as 32 bits with every compiler.
     */
    uint32_t kind;
    /**
     * What kind of element `first` is: a DelotetElement.
     */
    uint32_t first_element;
    /**
     * Index of the element that the warning is about.
     */
    uint32_t first;
    /**
     * What kind of element `second` is: a DelotetElement, DELOTET_ELEMENT_NONE if only one element is involved.
     */
    uint32_t second_element;
    /**
     * Index of the other element of a pair, or DELOTET_INVALID_INDEX.
     */
    uint32_t second;
    /**
     * 1 if `point` is set, else 0.
     */
    uint32_t has_point;
    /**
     * x y z of a point at or near the element (rounded); zeros if there is none.
     */
    double point[3];
} DelotetWarning;

/**
 * Borrowed warnings; NULL and 0 if there are none.
 */
typedef struct DelotetWarningsView {
    /**
     * The first of `count` warnings; DELOTET_AT(DelotetWarning, view, i) is the i-th.
     */
    const struct DelotetWarning *first;
    /**
     * Number of elements.
     */
    size_t count;
    /**
     * Bytes from one element to the next.
     */
    size_t stride;
} DelotetWarningsView;

/**
 * A face of the mesh.
 */
typedef struct DelotetFace {
    /**
     * The corners; `(b - a) x (c - a)` points from `tets[0]` to `tets[1]`.
     */
    uint32_t corners[3];
    /**
     * The tetrahedra on both sides, the smaller index first, or in the order of the subface if it is one; the second is
     * DELOTET_INVALID_INDEX on the boundary.
     */
    uint32_t tets[2];
    /**
     * Its subface, or DELOTET_INVALID_INDEX if it is not constrained.
     */
    uint32_t subface;
    /**
     * The marker of its subface, or 0.
     */
    int32_t marker;
} DelotetFace;

/**
 * Borrowed faces; NULL and 0 if there are none.
 */
typedef struct DelotetFacesView {
    /**
     * The first of `count` faces; DELOTET_AT(DelotetFace, view, i) is the i-th.
     */
    const struct DelotetFace *first;
    /**
     * Number of elements.
     */
    size_t count;
    /**
     * Bytes from one element to the next.
     */
    size_t stride;
} DelotetFacesView;

/**
 * An edge of the mesh.
 */
typedef struct DelotetEdge {
    /**
     * The ends, the smaller first.
     */
    uint32_t ends[2];
    /**
     * A tetrahedron that has this edge.
     */
    uint32_t tet;
    /**
     * Its subsegment, or DELOTET_INVALID_INDEX if it is not constrained.
     */
    uint32_t subsegment;
    /**
     * The marker of its subsegment, or 0.
     */
    int32_t marker;
} DelotetEdge;

/**
 * Borrowed edges; NULL and 0 if there are none.
 */
typedef struct DelotetEdgesView {
    /**
     * The first of `count` edges; DELOTET_AT(DelotetEdge, view, i) is the i-th.
     */
    const struct DelotetEdge *first;
    /**
     * Number of elements.
     */
    size_t count;
    /**
     * Bytes from one element to the next.
     */
    size_t stride;
} DelotetEdgesView;

/**
 * In which order the six mid-edge nodes follow the four corners of a tetrahedron: one of the DELOTET_NODE_ORDER_ constants.
 */
typedef uint32_t DelotetNodeOrder;

/**
 * Borrowed second-order nodes and tetrahedra.
 */
typedef struct DelotetSecondOrderView {
    /**
     * #nodes by 3 doubles: the mid-edge nodes, one per edge in the order of delotet_mesh_edges(). Node i has the index
     * #points + i.
     */
    const double *nodes;
    /**
     * Number of mid-edge nodes.
     */
    size_t node_count;
    /**
     * #tetrahedra by 10 indices: four corners, then six mid-edge nodes.
     */
    const uint32_t *tets;
    /**
     * Number of tetrahedra.
     */
    size_t tet_count;
} DelotetSecondOrderView;

/**
 * The measures of a tetrahedron. One that is not positive (in meshes of delotet_options_set_exact_form() only) counts as flat.
 */
typedef struct DelotetTetQuality {
    /**
     * The dihedral angles in degrees at the edges 01 02 03 12 13 23; 0 0 0 180 180 180 if it is not positive.
     */
    double dihedrals[6];
    /**
     * The circumradius over the length of the shortest edge; infinite if it is not positive.
     */
    double radius_edge;
    /**
     * The mean ratio 12 (3 V)^(2/3) / (sum of the squared edge lengths): 1 for the regular tetrahedron, 0 if it is not positive.
     */
    double eta;
    /**
     * The volume, negative if it is inverted. Beyond the range of doubles it is the largest of them, or zero.
     */
    double volume;
} DelotetTetQuality;

/**
 * Borrowed measures, one per tetrahedron; NULL and 0 if there are none.
 */
typedef struct DelotetTetQualitiesView {
    /**
     * The first of `count` records; DELOTET_AT(DelotetTetQuality, view, i) is the i-th.
     */
    const struct DelotetTetQuality *first;
    /**
     * Number of elements.
     */
    size_t count;
    /**
     * Bytes from one element to the next.
     */
    size_t stride;
} DelotetTetQualitiesView;

/**
 * The quality of a mesh at a glance. Arrays are indexed by measure (a DELOTET_QUALITY_ constant). Later versions append fields;
 * `struct_size` tells both sides which ones exist.
 */
typedef struct DelotetQualitySummary {
    /**
     * The caller sets it to sizeof(DelotetQualitySummary); the library sets it to the number of bytes written.
     */
    size_t struct_size;
    /**
     * The number of tetrahedra.
     */
    uint64_t tet_count;
    /**
     * How many of them are input-forced (delotet_mesh_forced_tets()).
     */
    uint64_t forced_count;
    /**
     * The worst value of each measure; 0 if there are no tetrahedra.
     */
    double worst[DELOTET_QUALITY_MEASURES];
    /**
     * The first tetrahedron with that value, or DELOTET_INVALID_INDEX if there are none.
     */
    uint32_t worst_tets[DELOTET_QUALITY_MEASURES];
    /**
     * The number of tetrahedra in each bin of each measure (delotet_quality_bin_edges()).
     */
    uint64_t histograms[DELOTET_QUALITY_MEASURES][DELOTET_QUALITY_BINS];
    /**
     * `worst` among the tetrahedra that are not input-forced.
     */
    double unforced_worst[DELOTET_QUALITY_MEASURES];
    /**
     * `worst_tets` among the tetrahedra that are not input-forced.
     */
    uint32_t unforced_worst_tets[DELOTET_QUALITY_MEASURES];
    /**
     * `histograms` of the tetrahedra that are not input-forced.
     */
    uint64_t unforced_histograms[DELOTET_QUALITY_MEASURES][DELOTET_QUALITY_BINS];
} DelotetQualitySummary;

/**
 * A measure of quality: one of the DELOTET_QUALITY_ constants.
 */
typedef uint32_t DelotetQualityMeasure;

/**
 * A tetrahedron in a narrow wedge between two facets; of several wedges the narrowest.
 */
typedef struct DelotetForcedTet {
    /**
     * The tetrahedron.
     */
    uint32_t tet;
    /**
     * The input facets on both sides of the wedge, the smaller index first.
     */
    uint32_t facets[2];
    /**
     * The ends of the edge where they meet, the smaller index first.
     */
    uint32_t ends[2];
    /**
     * The angle of the wedge in degrees.
     */
    double angle;
} DelotetForcedTet;

/**
 * Borrowed input-forced tetrahedra; NULL and 0 if there are none.
 */
typedef struct DelotetForcedTetsView {
    /**
     * The first of `count` records; DELOTET_AT(DelotetForcedTet, view, i) is the i-th.
     */
    const struct DelotetForcedTet *first;
    /**
     * Number of elements.
     */
    size_t count;
    /**
     * Bytes from one element to the next.
     */
    size_t stride;
} DelotetForcedTetsView;

/**
 * Why a tetrahedron is above a radius-edge ratio: one of the DELOTET_SKINNY_ constants. Of several causes the one with the smallest number
 * counts. Later versions may add causes.
 */
typedef uint32_t DelotetSkinnyCause;

/**
 * A tetrahedron above a radius-edge ratio.
 */
typedef struct DelotetSkinnyTet {
    /**
     * The tetrahedron.
     */
    uint32_t tet;
    /**
     * Why it is one: a DELOTET_SKINNY_ constant.
     */
    DelotetSkinnyCause cause;
    /**
     * The input facets that force it, the smaller index first; twice the same if it is one. With DELOTET_SKINNY_BESIDE those that force
     * what it is beside, with DELOTET_SKINNY_OTHER both are DELOTET_INVALID_INDEX.
     */
    uint32_t facets[2];
    /**
     * Its circumradius over its shortest edge.
     */
    double radius_edge;
} DelotetSkinnyTet;

/**
 * Borrowed tetrahedra above a radius-edge ratio; NULL and 0 if there are none.
 */
typedef struct DelotetSkinnyTetsView {
    /**
     * The first of `count` records; DELOTET_AT(DelotetSkinnyTet, view, i) is the i-th.
     */
    const struct DelotetSkinnyTet *first;
    /**
     * Number of elements.
     */
    size_t count;
    /**
     * Bytes from one element to the next.
     */
    size_t stride;
} DelotetSkinnyTetsView;

/**
 * An edge of a Voronoi diagram, dual to a face of the mesh.
 */
typedef struct DelotetVoronoiEdge {
    /**
     * Its ends; the second is DELOTET_INVALID_INDEX for a ray.
     */
    uint32_t vertices[2];
    /**
     * The direction of a ray, of length 1: the outward normal of the face of the convex hull. Zero for an edge with two ends.
     */
    double direction[3];
} DelotetVoronoiEdge;

/**
 * Borrowed edges of a Voronoi diagram; NULL and 0 if there are none.
 */
typedef struct DelotetVoronoiEdgesView {
    /**
     * The first of `count` edges; DELOTET_AT(DelotetVoronoiEdge, view, i) is the i-th.
     */
    const struct DelotetVoronoiEdge *first;
    /**
     * Number of elements.
     */
    size_t count;
    /**
     * Bytes from one element to the next.
     */
    size_t stride;
} DelotetVoronoiEdgesView;

/**
 * A facet of a Voronoi diagram, dual to an edge of the mesh: a convex polygon between two cells, in the plane of points that have equal
 * (power) distances from both.
 */
typedef struct DelotetVoronoiFacet {
    /**
     * Its cells: the points whose edge it is dual to, the smaller first.
     */
    uint32_t cells[2];
    /**
     * Where its edges begin in delotet_voronoi_facet_edges(). They follow each other counterclockwise, seen from the second point; if it
     * is unbounded, from one ray to the other.
     */
    size_t first;
    /**
     * The number of its edges.
     */
    uint32_t count;
    /**
     * Whether it is bounded.
     */
    bool bounded;
} DelotetVoronoiFacet;

/**
 * Borrowed facets of a Voronoi diagram; NULL and 0 if there are none.
 */
typedef struct DelotetVoronoiFacetsView {
    /**
     * The first of `count` facets; DELOTET_AT(DelotetVoronoiFacet, view, i) is the i-th.
     */
    const struct DelotetVoronoiFacet *first;
    /**
     * Number of elements.
     */
    size_t count;
    /**
     * Bytes from one element to the next.
     */
    size_t stride;
} DelotetVoronoiFacetsView;

/**
 * The cell of a point.
 */
typedef struct DelotetVoronoiCell {
    /**
     * Where its facets begin in delotet_voronoi_cell_facets(), ascending.
     */
    size_t first;
    /**
     * The number of its facets; 0 if there is no cell: the point is hidden by others, or equal to an earlier one.
     */
    uint32_t count;
    /**
     * Whether there is a cell, and it is bounded.
     */
    bool bounded;
} DelotetVoronoiCell;

/**
 * Borrowed cells of a Voronoi diagram; NULL and 0 if there are none.
 */
typedef struct DelotetVoronoiCellsView {
    /**
     * The first of `count` cells; DELOTET_AT(DelotetVoronoiCell, view, i) is the i-th.
     */
    const struct DelotetVoronoiCell *first;
    /**
     * Number of elements.
     */
    size_t count;
    /**
     * Bytes from one element to the next.
     */
    size_t stride;
} DelotetVoronoiCellsView;

/**
 * A version of Gmsh's format: one of the DELOTET_MSH_ constants.
 */
typedef uint32_t DelotetMshVersion;

/**
 * The Delaunay tetrahedralization of the points; segments and facets are ignored.
 */
#define DELOTET_MODE_DELAUNAY 0

/**
 * The constrained Delaunay tetrahedralization: segments and facets are unions of edges and faces, with Steiner points on
 * segments only, unless sizes or shapes ask for more points (delotet_options_set_size()). The default.
 */
#define DELOTET_MODE_CONSTRAINED 1

/**
 * A tetrahedralization that keeps the surface as it is: every triangle is a face, every segment and every edge of a polygon is an
 * edge, and no point is added on them; a polygon may get any diagonals. Points are added only inside, as few as possible.
 */
#define DELOTET_MODE_PRESERVE 2

/**
 * Every facet and segment. The default.
 */
#define DELOTET_PRESERVE_ALL 0

/**
 * The outer boundary: facets with the mesh on one side, and the segments on them. Other facets and segments (interfaces between regions,
 * dangling facets) are unions of faces and edges, with Steiner points on segments where keeping them would take points inside.
 */
#define DELOTET_PRESERVE_OUTER 1

/**
 * The first ring is the outer boundary, the others are holes in it (delotet_plc_add_facet(), and all facets of one ring).
 */
#define DELOTET_FACET_RULE_RINGS 0

/**
 * TetGen's rule: hole seeds mark the holes (delotet_plc_add_facet_with_hole_seeds()).
 */
#define DELOTET_FACET_RULE_SEEDS 1

/**
 * VTK, Abaqus and CalculiX (C3D10), Nastran: nodes on the edges 01 12 02 03 13 23.
 */
#define DELOTET_NODE_ORDER_VTK 0

/**
 * Gmsh: nodes on the edges 01 12 02 03 23 13.
 */
#define DELOTET_NODE_ORDER_GMSH 1

/**
 * TetGen (-o2): nodes on the edges 23 03 01 12 13 02.
 */
#define DELOTET_NODE_ORDER_TETGEN 2

/**
 * The smallest of the six dihedral angles, in degrees; up to 70.53. Smaller is worse.
 */
#define DELOTET_QUALITY_MIN_DIHEDRAL 0

/**
 * The largest of the six dihedral angles, in degrees; at least 70.53. Larger is worse.
 */
#define DELOTET_QUALITY_MAX_DIHEDRAL 1

/**
 * The circumradius over the shortest edge; at least 0.6124. Larger is worse.
 */
#define DELOTET_QUALITY_RADIUS_EDGE 2

/**
 * The mean ratio 12 (3 V)^(2/3) / (sum of the squared edge lengths), from 0 to 1. Smaller is worse.
 */
#define DELOTET_QUALITY_ETA 3

/**
 * Input-forced: in a narrow wedge between two facets (delotet_mesh_forced_tets()).
 */
#define DELOTET_SKINNY_WEDGE 0

/**
 * Input-forced: a face of it is in a corner of a facet (from one subsegment to the next around a point) of less than arcsin(1 / (2 ratio)):
 * every mesh of this input has tetrahedra above the ratio there.
 */
#define DELOTET_SKINNY_CORNER 1

/**
 * Input-forced: a face of it is a triangle of a surface that is kept, and above the ratio itself.
 */
#define DELOTET_SKINNY_FACE 2

/**
 * It has a point in common with an input-forced tetrahedron.
 */
#define DELOTET_SKINNY_BESIDE 3

/**
 * None of these.
 */
#define DELOTET_SKINNY_OTHER 4

/**
 * Version 4.1, that of Gmsh 4. The default.
 */
#define DELOTET_MSH_4_1 41

/**
 * Version 2.2, which many solvers read; some read no other.
 */
#define DELOTET_MSH_2_2 22

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * Version of the loaded library: 1,000,000 * major + 1,000 * minor + patch, like DELOTET_VERSION for the header. Before 1.0, library and
 * header must agree in major and minor version. May be called from any thread at any time; cannot fail.
 */
DELOTET_API
uint32_t delotet_version(void);

/**
 * Version of the loaded library as text, such as "1.2.3". Static: never NULL, never freed.
 */
DELOTET_API const char *delotet_version_string(void);

/**
 * Name of a status, such as "DELOTET_STATUS_SELF_INTERSECTION"; "unknown" for other numbers. Static: never NULL, never freed.
 */
DELOTET_API
const char *delotet_status_name(uint32_t status);

/**
 * Name of a kind of element, such as "DELOTET_ELEMENT_FACET"; "unknown" for other numbers. Static: never NULL, never freed.
 */
DELOTET_API
const char *delotet_element_name(uint32_t element);

/**
 * Name of a kind of defect, such as "DELOTET_DEFECT_KIND_OVERLAP"; "unknown" for other numbers. Static: never NULL, never freed.
 */
DELOTET_API
const char *delotet_defect_kind_name(uint32_t kind);

/**
 * Name of a kind of warning, such as "DELOTET_WARNING_KIND_OPEN_EDGE"; "unknown" for other numbers. Static: never NULL, never freed.
 */
DELOTET_API
const char *delotet_warning_kind_name(uint32_t kind);

/**
 * The fraction of the whole run that is done when `fraction` of `phase` is done, from 0 to 1: for a single progress bar. It never
 * decreases during a run, since phases come in order. The shares of the phases are rough estimates. 0 for unknown phases.
 */
DELOTET_API
double delotet_phase_overall(uint32_t phase,
                             double fraction);

/**
 * Name of a phase, such as "DELOTET_PHASE_FACETS"; "unknown" for other numbers. Static: never NULL, never freed.
 */
DELOTET_API
const char *delotet_phase_name(uint32_t phase);

/**
 * The status of `error`, the same as the failing call returned; DELOTET_STATUS_OK for NULL.
 */
DELOTET_API enum DelotetStatus delotet_error_status(const struct DelotetError *error);

/**
 * The message: one line of English, UTF-8. Borrowed from `error`: valid until it is freed. "" for NULL; never NULL.
 */
DELOTET_API
const char *delotet_error_message(const struct DelotetError *error);

/**
 * The defects that the error lists, at most as many as delotet_options_set_max_defects() allows. Borrowed from `error`: valid until it is
 * freed. Empty for NULL.
 */
DELOTET_API
struct DelotetDefectsView delotet_error_defects(const struct DelotetError *error);

/**
 * The number of defects found; the error may list fewer. 0 for NULL.
 */
DELOTET_API size_t delotet_error_defect_count(const struct DelotetError *error);

/**
 * Frees an error and everything borrowed from it. NULL is ignored.
 */
DELOTET_API void delotet_error_free(struct DelotetError *error);

/**
 * New options with the defaults that the setters document. The caller owns them; free them with delotet_options_free(). NULL only if
 * memory ran out.
 */
DELOTET_API
DELOTET_MUST_USE
struct DelotetOptions *delotet_options_new(void);

/**
 * Sets what is made: a DELOTET_MODE_ constant. Default: DELOTET_MODE_CONSTRAINED. Errors: INVALID_ARGUMENT (other values).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_mode(struct DelotetOptions *options,
                                            DelotetMode mode,
                                            struct DelotetError **out_error);

/**
 * Sets what DELOTET_MODE_PRESERVE keeps: a DELOTET_PRESERVE_ constant; other modes ignore it. Default: DELOTET_PRESERVE_ALL.
 * Errors: INVALID_ARGUMENT (other values).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_preserve(struct DelotetOptions *options,
                                                DelotetPreserve preserve,
                                                struct DelotetError **out_error);

/**
 * Keep every tetrahedron of the convex hull, holes and outside included (holes given by seeds are still carved).
 * Default: false. Errors: INVALID_ARGUMENT (NULL).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_keep_hull(struct DelotetOptions *options,
                                                 bool keep_hull,
                                                 struct DelotetError **out_error);

/**
 * Treat facets with equal markers that meet at more than `angle` degrees (90 to 180) as one smooth patch, and flip its triangles to be
 * Delaunay on the surface before meshing; delotet_mesh_facet_flips() lists the flips. 0, the default: off. Errors: INVALID_ARGUMENT.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_merge_facets(struct DelotetOptions *options,
                                                    double angle,
                                                    struct DelotetError **out_error);

/**
 * Look for self-intersections and all other defects before meshing. Default: true. Without it an invalid PLC may cause
 * DELOTET_STATUS_INTERNAL. Errors: INVALID_ARGUMENT (NULL).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_validate(struct DelotetOptions *options,
                                                bool validate,
                                                struct DelotetError **out_error);

/**
 * Sets how many defects an error lists at most, and how many warnings of each kind a mesh lists. Default: 1000. Errors: INVALID_ARGUMENT
 * (NULL).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_max_defects(struct DelotetOptions *options,
                                                   size_t max_defects,
                                                   struct DelotetError **out_error);

/**
 * Sets the number of worker threads; 0: one per processor available to the process. The mesh is the same, bit for bit, for any number.
 * Default: 1.
 * Errors: INVALID_ARGUMENT (NULL).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_threads(struct DelotetOptions *options,
                                               size_t threads,
                                               struct DelotetError **out_error);

/**
 * Fail with DELOTET_STATUS_STEINER_LIMIT if the mesh needs more Steiner points than this; those that DELOTET_MODE_PRESERVE removes again
 * count where it starts from the constrained Delaunay tetrahedralization. UINT64_MAX, the default: 100,000 plus 100 per segment, and no
 * limit on points of filling.
 * Errors: INVALID_ARGUMENT (NULL).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_steiner_limit(struct DelotetOptions *options,
                                                     uint64_t limit,
                                                     struct DelotetError **out_error);

/**
 * Return the mesh even if some Steiner points have no valid position in doubles, instead of failing with DELOTET_STATUS_ROUNDING.
 * delotet_mesh_crowded_points() lists these points; tetrahedra at them may be flat or inverted in doubles; delotet_mesh_steiner_points()
 * gives the exact mesh. Default: false. Errors: INVALID_ARGUMENT (NULL).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_exact_form(struct DelotetOptions *options,
                                                  bool exact_form,
                                                  struct DelotetError **out_error);

/**
 * Leave out points that belong to no tetrahedron: those that equal an earlier one, and those around which everything was carved. Input
 * points then have other indices in the mesh, which delotet_mesh_point_map() gives. Unmeshed subfaces and subsegments are not listed,
 * since their points are dropped; warnings about them remain. Default: false. Errors: INVALID_ARGUMENT (NULL).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_drop_unmeshed_points(struct DelotetOptions *options,
                                                            bool drop_unmeshed_points,
                                                            struct DelotetError **out_error);

/**
 * The points are already in a spatially coherent order: skip sorting. Default: false. Errors: INVALID_ARGUMENT (NULL).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_points_sorted(struct DelotetOptions *options,
                                                     bool points_sorted,
                                                     struct DelotetError **out_error);

/**
 * Sets the callback that receives progress; `user_data` is passed to it unchanged. NULL, the default: none.
 * Errors: INVALID_ARGUMENT (options is NULL).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_progress(struct DelotetOptions *options,
                                                DelotetProgressFn callback,
                                                void *user_data,
                                                struct DelotetError **out_error);

/**
 * Sets the callback that receives log lines; `user_data` is passed to it unchanged. NULL, the default: none. The library itself never
 * prints. Errors: INVALID_ARGUMENT (options is NULL).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_log(struct DelotetOptions *options,
                                           DelotetLogFn callback,
                                           void *user_data,
                                           struct DelotetError **out_error);

/**
 * The mode, as set by delotet_options_set_mode(). All getters return the default for NULL.
 */
DELOTET_API DelotetMode delotet_options_mode(const struct DelotetOptions *options);

/**
 * What DELOTET_MODE_PRESERVE keeps, as set by delotet_options_set_preserve().
 */
DELOTET_API DelotetPreserve delotet_options_preserve(const struct DelotetOptions *options);

/**
 * Whether the convex hull is kept, as set by delotet_options_set_keep_hull().
 */
DELOTET_API bool delotet_options_keep_hull(const struct DelotetOptions *options);

/**
 * The angle of facet merging in degrees, 0 if it is off, as set by delotet_options_set_merge_facets().
 */
DELOTET_API double delotet_options_merge_facets(const struct DelotetOptions *options);

/**
 * Whether the input is validated, as set by delotet_options_set_validate().
 */
DELOTET_API bool delotet_options_validate(const struct DelotetOptions *options);

/**
 * How many defects an error lists at most, as set by delotet_options_set_max_defects().
 */
DELOTET_API size_t delotet_options_max_defects(const struct DelotetOptions *options);

/**
 * The number of worker threads, as set by delotet_options_set_threads().
 */
DELOTET_API size_t delotet_options_threads(const struct DelotetOptions *options);

/**
 * The limit on Steiner points, UINT64_MAX for the default limit, as set by delotet_options_set_steiner_limit().
 */
DELOTET_API
uint64_t delotet_options_steiner_limit(const struct DelotetOptions *options);

/**
 * Whether a mesh without valid double coordinates is returned, as set by delotet_options_set_exact_form().
 */
DELOTET_API bool delotet_options_exact_form(const struct DelotetOptions *options);

/**
 * Whether points that belong to no tetrahedron are left out, as set by delotet_options_set_drop_unmeshed_points().
 */
DELOTET_API
bool delotet_options_drop_unmeshed_points(const struct DelotetOptions *options);

/**
 * Whether sorting is skipped, as set by delotet_options_set_points_sorted().
 */
DELOTET_API bool delotet_options_points_sorted(const struct DelotetOptions *options);

/**
 * The progress callback, NULL if there is none, as set by delotet_options_set_progress().
 * `out_user_data`: NULL, or receives the pointer that was set with it (NULL without a callback).
 */
DELOTET_API
DelotetProgressFn delotet_options_progress(const struct DelotetOptions *options,
                                           void **out_user_data);

/**
 * The log callback, NULL if there is none, as set by delotet_options_set_log().
 * `out_user_data`: NULL, or receives the pointer that was set with it (NULL without a callback).
 */
DELOTET_API DelotetLogFn delotet_options_log(const struct DelotetOptions *options, void **out_user_data);

/**
 * Frees options. NULL is ignored. No run may be using them.
 */
DELOTET_API void delotet_options_free(struct DelotetOptions *options);

/**
 * A new token, not cancelled. The caller owns it; free it with delotet_cancel_token_free(). NULL only if memory ran out.
 */
DELOTET_API
DELOTET_MUST_USE
struct DelotetCancelToken *delotet_cancel_token_new(void);

/**
 * Cancels all runs that use the token, also those that begin later: they fail with DELOTET_STATUS_CANCELLED within a fraction of a second.
 * Returns at once; takes no lock and allocates nothing, so that signal handlers may call it. NULL is ignored.
 */
DELOTET_API
void delotet_cancel_token_cancel(const struct DelotetCancelToken *token);

/**
 * Whether the token is cancelled; false for NULL.
 */
DELOTET_API bool delotet_cancel_token_is_cancelled(const struct DelotetCancelToken *token);

/**
 * Makes the token usable again. A run that has not yet seen that it was cancelled goes on. NULL is ignored.
 */
DELOTET_API void delotet_cancel_token_reset(const struct DelotetCancelToken *token);

/**
 * Gives up the caller's part in a token, which must not be used by the caller any more. Options that have it keep it until they are freed
 * or get another one. NULL is ignored.
 */
DELOTET_API
void delotet_cancel_token_free(struct DelotetCancelToken *token);

/**
 * Sets the token that cancels runs with these options. NULL, the default: none. Errors: INVALID_ARGUMENT (options is NULL).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_cancel_token(struct DelotetOptions *options,
                                                    const struct DelotetCancelToken *token,
                                                    struct DelotetError **out_error);

/**
 * The token, NULL if there is none, as set by delotet_options_set_cancel_token(). Borrowed from `options`: valid until they get another
 * one or are freed.
 */
DELOTET_API
const struct DelotetCancelToken *delotet_options_cancel_token(const struct DelotetOptions *options);

/**
 * Fail with DELOTET_STATUS_TIME_LIMIT this many seconds after the beginning of a call. 0, the default: no limit. Errors: INVALID_ARGUMENT
 * (negative or not finite).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_time_limit(struct DelotetOptions *options,
                                                  double seconds,
                                                  struct DelotetError **out_error);

/**
 * The limit on time in seconds, 0 if there is none, as set by delotet_options_set_time_limit().
 */
DELOTET_API double delotet_options_time_limit(const struct DelotetOptions *options);

/**
 * Fail with DELOTET_STATUS_MEMORY_LIMIT before the resident memory of the process has grown by more than this many bytes since the
 * beginning of a call. Concurrent calls and the host's other threads count, since only the whole process is measured. What is
 * taken between two readings may exceed it. Linux only: other systems count only the large tables of the engine. 0, the default: no limit.
 * Errors: INVALID_ARGUMENT (NULL).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_memory_limit(struct DelotetOptions *options,
                                                    uint64_t bytes,
                                                    struct DelotetError **out_error);

/**
 * The limit on memory in bytes, 0 if there is none, as set by delotet_options_set_memory_limit().
 */
DELOTET_API uint64_t delotet_options_memory_limit(const struct DelotetOptions *options);

/**
 * Fail with DELOTET_STATUS_TETRAHEDRA_LIMIT once the mesh has more tetrahedra than this: while it is filled, refined or optimised, or in the
 * end. UINT64_MAX, the default: no limit. Errors: INVALID_ARGUMENT (NULL).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_tetrahedra_limit(struct DelotetOptions *options,
                                                        uint64_t limit,
                                                        struct DelotetError **out_error);

/**
 * The limit on tetrahedra, UINT64_MAX if there is none, as set by delotet_options_set_tetrahedra_limit().
 */
DELOTET_API uint64_t delotet_options_tetrahedra_limit(const struct DelotetOptions *options);

/**
 * Creates a PLC with these points and nothing else.
 * `xyz`: #points by 3 doubles, x y z per point; copied; may be NULL if `point_count` is 0. Finiteness is checked later, by
 * delotet_plc_check() and delotet_tetrahedralize().
 * `out_plc`: the PLC, owned by the caller; free it with delotet_plc_free(). NULL on failure.
 * `out_error`: may be NULL; receives NULL on success, otherwise an error to be freed with delotet_error_free(). The same holds for all
 * functions here.
 * Errors: INVALID_ARGUMENT, TOO_LARGE (2^32 - 1 points or more), OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_new(const double *xyz,
                                   size_t point_count,
                                   struct DelotetPlc **out_plc,
                                   struct DelotetError **out_error);

/**
 * Copies a PLC with everything in it.
 * `out_plc`: the copy, owned by the caller; free it with delotet_plc_free(). NULL on failure. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_clone(const struct DelotetPlc *plc,
                                     struct DelotetPlc **out_plc,
                                     struct DelotetError **out_error);

/**
 * Appends points. Their attributes and markers are 0, if the points have any.
 * `xyz`: #points by 3 doubles; copied. `out_first`: NULL, or receives the index of the first new point (the others follow).
 * Errors: INVALID_ARGUMENT, TOO_LARGE, OUT_OF_MEMORY; then nothing was added.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_add_points(struct DelotetPlc *plc,
                                          const double *xyz,
                                          size_t count,
                                          uint32_t *out_first,
                                          struct DelotetError **out_error);

/**
 * Sets the attributes of all points, replacing earlier ones. They are passed on to the mesh, and interpolated linearly at Steiner points.
 * `attributes`: #points by `attribute_count` doubles; copied. `attribute_count` 0 removes them.
 * Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_set_point_attributes(struct DelotetPlc *plc,
                                                    const double *attributes,
                                                    size_t attribute_count,
                                                    struct DelotetError **out_error);

/**
 * Sets the markers of all points, replacing earlier ones.
 * `markers`: #points integers; copied; NULL removes them. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_set_point_markers(struct DelotetPlc *plc,
                                                 const int32_t *markers,
                                                 struct DelotetError **out_error);

/**
 * Sets the markers of all segments, replacing earlier ones.
 * `markers`: #segments integers; copied; NULL sets all to 0. Errors: INVALID_ARGUMENT.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_set_segment_markers(struct DelotetPlc *plc,
                                                   const int32_t *markers,
                                                   struct DelotetError **out_error);

/**
 * Sets the markers of all facets, replacing earlier ones.
 * `markers`: #facets integers; copied; NULL sets all to 0. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_set_facet_markers(struct DelotetPlc *plc,
                                                 const int32_t *markers,
                                                 struct DelotetError **out_error);

/**
 * Sets the marker of one facet. Errors: INVALID_ARGUMENT, INDEX_OUT_OF_RANGE, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_set_facet_marker(struct DelotetPlc *plc,
                                                uint32_t facet,
                                                int32_t marker,
                                                struct DelotetError **out_error);

/**
 * Names a facet marker; files use such names for groups. `name`: UTF-8, zero-terminated; its first line is copied; NULL or "" removes the
 * name. Errors: INVALID_ARGUMENT (also if `name` is not UTF-8), OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_set_marker_name(struct DelotetPlc *plc,
                                               int32_t marker,
                                               const char *name,
                                               struct DelotetError **out_error);

/**
 * Adds a segment from point `a` to point `b`. Facet edges need not be added, unless they carry a marker.
 * Errors: INVALID_ARGUMENT, INDEX_OUT_OF_RANGE, TOO_LARGE, OUT_OF_MEMORY; then nothing was added.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_add_segment(struct DelotetPlc *plc,
                                           uint32_t a,
                                           uint32_t b,
                                           int32_t marker,
                                           struct DelotetError **out_error);

/**
 * Adds `count` segments.
 * `ends`: #segments by 2 point indices; copied. `markers`: #segments integers, or NULL (all 0).
 * Errors: INVALID_ARGUMENT, INDEX_OUT_OF_RANGE, TOO_LARGE, OUT_OF_MEMORY; then nothing was added.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_add_segments(struct DelotetPlc *plc,
                                            const uint32_t *ends,
                                            const int32_t *markers,
                                            size_t count,
                                            struct DelotetError **out_error);

/**
 * Adds `count` triangular facets.
 * `corners`: #triangles by 3 point indices; copied. `markers`: #triangles integers, or NULL (all 0). Corners may be in either order.
 * Coplanar neighbours with equal markers are meshed as one facet: the edge between them need not be an edge of the mesh, unless it is also
 * a segment.
 * Errors: INVALID_ARGUMENT, INDEX_OUT_OF_RANGE, TOO_LARGE, OUT_OF_MEMORY; then nothing was added.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_add_triangles(struct DelotetPlc *plc,
                                             const uint32_t *corners,
                                             const int32_t *markers,
                                             size_t count,
                                             struct DelotetError **out_error);

/**
 * Adds `count` facets of one polygon each (quadrilaterals, any planar polygon).
 * `corners`: the corner indices of all polygons, one after the other; `polygon_ends`: #polygons ascending positions: polygon i
 * has the corners from `polygon_ends[i - 1]` (0 for the first) up to, not including, `polygon_ends[i]`. Copied.
 * `markers`: #polygons integers, or NULL (all 0).
 * Errors: INVALID_ARGUMENT, INDEX_OUT_OF_RANGE, TOO_LARGE, OUT_OF_MEMORY; then nothing was added.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_add_polygons(struct DelotetPlc *plc,
                                            const uint32_t *corners,
                                            const size_t *polygon_ends,
                                            const int32_t *markers,
                                            size_t count,
                                            struct DelotetError **out_error);

/**
 * Adds one planar facet with holes: the first ring is its outer boundary, all others (three corners or more) are holes in it. Rings of one
 * or two corners are points and edges in the facet that the mesh must contain.
 * `corners`: the corner indices of all rings, one after the other; `ring_ends`: #rings ascending positions, as for
 * delotet_plc_add_polygons(). Copied.
 * Errors: INVALID_ARGUMENT, INDEX_OUT_OF_RANGE, TOO_LARGE, OUT_OF_MEMORY; then nothing was added.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_add_facet(struct DelotetPlc *plc,
                                         const uint32_t *corners,
                                         const size_t *ring_ends,
                                         size_t ring_count,
                                         int32_t marker,
                                         struct DelotetError **out_error);

/**
 * Adds one planar facet by TetGen's rule: the facet is what cannot be reached from outside without crossing a polygon's edge, except what
 * can be reached from a hole seed. Inner polygons and polygons of two corners only constrain the mesh.
 * `corners`, `polygon_ends`: as for delotet_plc_add_facet(). `hole_seeds`: #holes by 3 doubles, one point in each hole; copied; may be
 * NULL if `hole_count` is 0.
 * Errors: INVALID_ARGUMENT, INDEX_OUT_OF_RANGE, TOO_LARGE, OUT_OF_MEMORY; then nothing was added.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_add_facet_with_hole_seeds(struct DelotetPlc *plc,
                                                         const uint32_t *corners,
                                                         const size_t *polygon_ends,
                                                         size_t polygon_count,
                                                         const double *hole_seeds,
                                                         size_t hole_count,
                                                         int32_t marker,
                                                         struct DelotetError **out_error);

/**
 * Adds a hole: everything reachable from the point `seed` (x y z) without crossing a facet is left unmeshed.
 * Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. Whether the seed lies inside is checked later.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_add_hole(struct DelotetPlc *plc,
                                        const double *seed,
                                        struct DelotetError **out_error);

/**
 * Adds a region: the tetrahedra reachable from the point `seed` (x y z) without crossing a facet get `attribute`. `max_volume`: bound on
 * the volume of a tetrahedron there, kept once the mesh is filled (delotet_options_set_quality() and others); none if it is not positive.
 * Errors: INVALID_ARGUMENT (NULL or NaN), OUT_OF_MEMORY. Whether the seed lies inside is checked later.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_add_region(struct DelotetPlc *plc,
                                          const double *seed,
                                          double attribute,
                                          double max_volume,
                                          struct DelotetError **out_error);

/**
 * Looks for defects: non-finite points, elements without extent, self-intersections, unusable polygons. The error lists all of them, up to
 * the maximum of `options`, which may be NULL (the defaults). The callbacks of `options` receive progress and may cancel. A surface that
 * encloses nothing fails too, with its open edges listed, unless `options` keep the hull or ask for DELOTET_MODE_DELAUNAY; if only part of
 * the surface encloses nothing, the log gets a warning.
 * Errors: INVALID_ARGUMENT, the statuses from 10 to 29, CANCELLED, TIME_LIMIT, MEMORY_LIMIT, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_check(const struct DelotetPlc *plc,
                                     const struct DelotetOptions *options,
                                     struct DelotetError **out_error);

/**
 * Frees a PLC and everything borrowed from it. NULL is ignored. Meshes made from it stay valid.
 */
DELOTET_API void delotet_plc_free(struct DelotetPlc *plc);

/**
 * The points: #points by 3 doubles. Borrowed from `plc`: valid until it is changed or freed. Empty for NULL.
 */
DELOTET_API struct DelotetPointsView delotet_plc_points(const struct DelotetPlc *plc);

/**
 * The attributes of the points: #points by `width` doubles. Borrowed from `plc`: valid until it is changed or freed. Empty for
 * NULL and without attributes.
 */
DELOTET_API
struct DelotetDoublesView delotet_plc_point_attributes(const struct DelotetPlc *plc);

/**
 * The markers of the points: one per point, or none at all. Borrowed from `plc`: valid until it is changed or freed. Empty for NULL.
 */
DELOTET_API
struct DelotetMarkersView delotet_plc_point_markers(const struct DelotetPlc *plc);

/**
 * The number of segments. 0 for NULL.
 */
DELOTET_API size_t delotet_plc_segment_count(const struct DelotetPlc *plc);

/**
 * The number of facets, triangles and others. 0 for NULL.
 */
DELOTET_API size_t delotet_plc_facet_count(const struct DelotetPlc *plc);

/**
 * The marker of a facet; 0 for NULL and for facets that do not exist.
 */
DELOTET_API int32_t delotet_plc_facet_marker(const struct DelotetPlc *plc, uint32_t facet);

/**
 * The segments. Borrowed from `plc`: valid until it is changed or freed. Empty for NULL.
 */
DELOTET_API struct DelotetSegmentsView delotet_plc_segments(const struct DelotetPlc *plc);

/**
 * The hole seeds: #holes by 3 doubles. Borrowed from `plc`: valid until it is changed or freed. Empty for NULL.
 */
DELOTET_API
struct DelotetPointsView delotet_plc_holes(const struct DelotetPlc *plc);

/**
 * The region seeds. Borrowed from `plc`: valid until it is changed or freed. Empty for NULL.
 */
DELOTET_API struct DelotetRegionSeedsView delotet_plc_regions(const struct DelotetPlc *plc);

/**
 * The triangles that come first among the facets: #triangles by 3 indices, facets 0 to #triangles - 1. They end at the first facet that
 * was not added as a triangle; delotet_plc_facet_ring() works for every facet. Borrowed from `plc`: valid until it is changed or freed.
 * Empty for NULL.
 */
DELOTET_API
struct DelotetIndexRowsView delotet_plc_triangles(const struct DelotetPlc *plc);

/**
 * The number of rings (polygons) of a facet: 1 for triangles. 0 for NULL and for facets that do not exist.
 */
DELOTET_API size_t delotet_plc_facet_ring_count(const struct DelotetPlc *plc, uint32_t facet);

/**
 * The corners of a ring of a facet, in the order given. Borrowed from `plc`: valid until it is changed or freed. Empty for NULL and for
 * rings that do not exist.
 */
DELOTET_API
struct DelotetIndicesView delotet_plc_facet_ring(const struct DelotetPlc *plc,
                                                 uint32_t facet,
                                                 size_t ring);

/**
 * How the rings of a facet bound it. DELOTET_FACET_RULE_RINGS for NULL and for facets that do not exist.
 */
DELOTET_API DelotetFacetRule delotet_plc_facet_rule(const struct DelotetPlc *plc, uint32_t facet);

/**
 * The points in the holes of a facet: #holes by 3 doubles. Borrowed from `plc`: valid until it is changed or freed. Empty for NULL,
 * for facets that do not exist, and for facets without such seeds.
 */
DELOTET_API
struct DelotetPointsView delotet_plc_facet_hole_seeds(const struct DelotetPlc *plc,
                                                      uint32_t facet);

/**
 * The number of facet markers with names: from the groups, solids, materials or colours of a file, or set by
 * delotet_plc_set_marker_name(). 0 for NULL.
 */
DELOTET_API size_t delotet_plc_marker_name_count(const struct DelotetPlc *plc);

/**
 * The name of a facet marker, UTF-8, zero-terminated; NULL if it has none or `plc` is NULL. Borrowed from `plc`: valid until it is changed
 * or freed.
 */
DELOTET_API
const char *delotet_plc_marker_name(const struct DelotetPlc *plc,
                                    int32_t marker);

/**
 * The marker with index `index` among those with names, in ascending order. 0 for NULL and if `index` is not below
 * delotet_plc_marker_name_count().
 */
DELOTET_API
int32_t delotet_plc_named_marker(const struct DelotetPlc *plc,
                                 size_t index);

/**
 * Sets the largest edge length wanted anywhere, in the units of the coordinates: the mesh is filled with points. The smallest of all sizes
 * counts: this one, those of the input (delotet_plc_set_point_sizes() and so on), that of the size function, and what follows from the
 * lengths of the surface and the gradation. In DELOTET_MODE_CONSTRAINED the surface is refined too: points come on segments, exactly on
 * facets, and inside. In DELOTET_MODE_PRESERVE they come only inside. In DELOTET_MODE_DELAUNAY delotet_tetrahedralize() fails with
 * INVALID_ARGUMENT. 0, the default: off. Errors: INVALID_ARGUMENT (negative or not finite).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_size(struct DelotetOptions *options,
                                            double size,
                                            struct DelotetError **out_error);

/**
 * The largest edge length wanted inside, 0 if there is none, as set by delotet_options_set_size().
 */
DELOTET_API double delotet_options_size(const struct DelotetOptions *options);

/**
 * Sets the largest volume of a tetrahedron, in cubed units of the coordinates: the mesh is filled with points until none is above it where
 * the surface allows that. The bounds of regions (delotet_plc_add_region()) count beside it once the mesh is filled. Modes as for
 * delotet_options_set_size(). 0, the default: off. Errors: INVALID_ARGUMENT (negative or not finite).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_max_volume(struct DelotetOptions *options,
                                                  double volume,
                                                  struct DelotetError **out_error);

/**
 * The largest volume of a tetrahedron, 0 if there is no bound, as set by delotet_options_set_max_volume().
 */
DELOTET_API double delotet_options_max_volume(const struct DelotetOptions *options);

/**
 * Sets how fast sizes may grow: by at most this many times the distance. More than 0, at most 1. Has an effect only where the mesh is
 * filled. Default: 0.3. Errors: INVALID_ARGUMENT (other values).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_gradation(struct DelotetOptions *options,
                                                 double gradation,
                                                 struct DelotetError **out_error);

/**
 * How fast sizes may grow, as set by delotet_options_set_gradation().
 */
DELOTET_API double delotet_options_gradation(const struct DelotetOptions *options);

/**
 * Fill the mesh with points until no tetrahedron's circumradius is more than `ratio` times its shortest edge, where the surface allows
 * that. Without other sizes those of the surface count, and grow inwards by the gradation. The number of points is bounded: at small
 * angles, in needles and in thin plates tetrahedra stay bad. At least 1; 1.4 to 2 are good values. Modes as for delotet_options_set_size().
 * 0, the default: off. Errors: INVALID_ARGUMENT (other values below 1, or not finite).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_quality(struct DelotetOptions *options,
                                               double ratio,
                                               struct DelotetError **out_error);

/**
 * The largest radius-edge ratio wanted, 0 if there is no bound, as set by delotet_options_set_quality().
 */
DELOTET_API double delotet_options_quality(const struct DelotetOptions *options);

/**
 * Sets the effort to optimise the smallest dihedral angles: 0, the default, is none, 1 is as much as pays, larger numbers take longer and
 * find more. Modes as for delotet_options_set_size(). In DELOTET_MODE_CONSTRAINED facets and segments are then unions of faces and edges, but
 * the mesh need not be Delaunay; together with delotet_options_set_exact_form() delotet_tetrahedralize() fails there with INVALID_ARGUMENT.
 * Errors: INVALID_ARGUMENT (NULL).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_optimize(struct DelotetOptions *options,
                                                uint32_t effort,
                                                struct DelotetError **out_error);

/**
 * The effort of optimisation, as set by delotet_options_set_optimize().
 */
DELOTET_API uint32_t delotet_options_optimize(const struct DelotetOptions *options);

/**
 * Optimise for so many seconds instead of by an effort, as with the largest effort: until nothing is gained any more, or the time is over. What
 * the mesh is then is the result, which so depends on the machine and its load. They count from the beginning of the optimisation; limits
 * (delotet_options_set_time_limit()) still end the call. Otherwise as delotet_options_set_optimize(). 0, the default: the effort counts.
 * Errors: INVALID_ARGUMENT (negative or not finite).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_optimize_seconds(struct DelotetOptions *options,
                                                        double seconds,
                                                        struct DelotetError **out_error);

/**
 * The seconds of optimisation, 0 if the effort counts, as set by delotet_options_set_optimize_seconds().
 */
DELOTET_API double delotet_options_optimize_seconds(const struct DelotetOptions *options);

/**
 * Sets the smallest dihedral angle that is wanted, in degrees: what is below it after the optimisation, or above 180 less it, is worked on
 * further; if it is not reached, larger efforts of up to 3 are tried from the start, and the best counts. Angles of the input bound what can be reached. At most 60. Otherwise as
 * delotet_options_set_optimize(). 0, the default: none. Errors: INVALID_ARGUMENT (negative, above 60, not finite).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_min_angle(struct DelotetOptions *options,
                                                 double degrees,
                                                 struct DelotetError **out_error);

/**
 * The smallest dihedral angle wanted, in degrees, 0 if there is none, as set by delotet_options_set_min_angle().
 */
DELOTET_API
double delotet_options_min_angle(const struct DelotetOptions *options);

/**
 * Sets the function that gives the edge length wanted at a point; `user_data` is passed to it unchanged. It is one size among the others:
 * see delotet_options_set_size(), also for modes. NULL, the default: none. Errors: INVALID_ARGUMENT (options is NULL).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_size_function(struct DelotetOptions *options,
                                                     DelotetSizeFunction function,
                                                     void *user_data,
                                                     struct DelotetError **out_error);

/**
 * The size function, NULL if there is none, as set by delotet_options_set_size_function().
 * `out_user_data`: NULL, or receives the pointer that was set with it (NULL without a function).
 */
DELOTET_API
DelotetSizeFunction delotet_options_size_function(const struct DelotetOptions *options,
                                                  void **out_user_data);

/**
 * Sets a background mesh: the edge length wanted at a place inside of it is linear between the sizes at the corners of its tetrahedron there;
 * outside there is no wish. It fills, as the size function does: see delotet_options_set_size(), also for modes; beside a size function the
 * smaller one counts.
 * `mesh`: any mesh, NULL removes the background. Copied, as far as needed: it may be freed at once. `sizes`: one per point of the mesh,
 * positive, infinite for no wish in the tetrahedra there; copied; may be NULL if `mesh` is. `count`: the number of points of the mesh.
 * Errors: INVALID_ARGUMENT (the message names the point), OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_background(struct DelotetOptions *options,
                                                  const struct DelotetMesh *mesh,
                                                  const double *sizes,
                                                  size_t count,
                                                  struct DelotetError **out_error);

/**
 * The sizes at the points of the background mesh, as set by delotet_options_set_background(): #points by 1 double. Borrowed from `options`:
 * valid until they get another one or are freed. Empty without one, and for NULL.
 */
DELOTET_API
struct DelotetDoublesView delotet_options_background(const struct DelotetOptions *options);

/**
 * Sets the edge length wanted at each point, replacing earlier ones; points that are added later have none.
 * `sizes`: one per point, positive, infinite where there is no wish; copied; may be NULL if `count` is 0. `count`: the number of points, or
 * 0, which removes all. Sizes are wishes for filling (delotet_options_set_size()): by themselves they fill nothing. Errors:
 * INVALID_ARGUMENT, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_set_point_sizes(struct DelotetPlc *plc,
                                               const double *sizes,
                                               size_t count,
                                               struct DelotetError **out_error);

/**
 * The sizes of the points: #points by 1 double, or none at all. Borrowed from `plc`: valid until it is changed or freed. Empty for NULL.
 */
DELOTET_API
struct DelotetDoublesView delotet_plc_point_sizes(const struct DelotetPlc *plc);

/**
 * Sets the edge length wanted at the facets with a marker, replacing an earlier one. `size`: positive; infinite removes it. As a wish for
 * filling: see delotet_plc_set_point_sizes(). Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_set_facet_size(struct DelotetPlc *plc,
                                              int32_t marker,
                                              double size,
                                              struct DelotetError **out_error);

/**
 * The edge length wanted at the facets with a marker; infinite if there is none, and for NULL.
 */
DELOTET_API double delotet_plc_facet_size(const struct DelotetPlc *plc, int32_t marker);

/**
 * Sets the largest area wanted of a subface of the facets with a marker, in squared units of the coordinates, replacing an earlier one. As a
 * length it is the edge of the equilateral triangle of this area; of length and area the smaller counts. Where the surface is refined
 * (DELOTET_MODE_CONSTRAINED), subfaces are split until none is above it; only segments that are close to each other for their length, and so in
 * each other's way, may keep some larger. `area`: positive; infinite removes it. As a wish for filling: see
 * delotet_plc_set_point_sizes(). Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_set_facet_area(struct DelotetPlc *plc,
                                              int32_t marker,
                                              double area,
                                              struct DelotetError **out_error);

/**
 * The largest area wanted at the facets with a marker; infinite if there is none, and for NULL.
 */
DELOTET_API double delotet_plc_facet_area(const struct DelotetPlc *plc, int32_t marker);

/**
 * Sets the edge length wanted at the segments with a marker; otherwise as delotet_plc_set_facet_size().
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_set_segment_size(struct DelotetPlc *plc,
                                                int32_t marker,
                                                double size,
                                                struct DelotetError **out_error);

/**
 * The edge length wanted at the segments with a marker; infinite if there is none, and for NULL.
 */
DELOTET_API double delotet_plc_segment_size(const struct DelotetPlc *plc, int32_t marker);

/**
 * Sets the edge length wanted in the regions with an attribute (delotet_plc_add_region()); otherwise as delotet_plc_set_facet_size().
 * Errors: INVALID_ARGUMENT (also for an attribute that is NaN), OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_set_region_size(struct DelotetPlc *plc,
                                               double attribute,
                                               double size,
                                               struct DelotetError **out_error);

/**
 * The edge length wanted in the regions with an attribute; infinite if there is none, and for NULL.
 */
DELOTET_API double delotet_plc_region_size(const struct DelotetPlc *plc, double attribute);

/**
 * All points: the input points first, bit for bit and in input order, then the Steiner points. Borrowed from `mesh`: valid until
 * it is freed, as all views of a mesh are. Empty for NULL.
 */
DELOTET_API
struct DelotetPointsView delotet_mesh_points(const struct DelotetMesh *mesh);

/**
 * The number of points that are input points. 0 for NULL.
 */
DELOTET_API size_t delotet_mesh_input_point_count(const struct DelotetMesh *mesh);

/**
 * For each input point the first input point with the same coordinates (itself if there is no earlier one): tetrahedra use only that one.
 * Borrowed from `mesh`. Empty for NULL.
 */
DELOTET_API
struct DelotetIndicesView delotet_mesh_point_aliases(const struct DelotetMesh *mesh);

/**
 * Where the input points are in a mesh made with delotet_options_set_drop_unmeshed_points(): for each input point its index in
 * delotet_mesh_points(), or the index of the earlier point that it equals; DELOTET_INVALID_INDEX if it was left out. Borrowed from `mesh`.
 * Empty for NULL and without that option: points then keep their indices.
 */
DELOTET_API
struct DelotetIndicesView delotet_mesh_point_map(const struct DelotetMesh *mesh);

/**
 * Points without a valid position in doubles: empty unless delotet_options_set_exact_form() was on and rounding failed.
 * Borrowed from `mesh`. Empty for NULL.
 */
DELOTET_API
struct DelotetIndicesView delotet_mesh_crowded_points(const struct DelotetMesh *mesh);

/**
 * Tetrahedra that replace ones for which no double coordinates gave a positive volume, in ascending order: nearly flat facets force them.
 * They are positive, but not necessarily Delaunay. Where sheets are too close for Steiner points on the surface in doubles, the mesh has
 * no such points, and these are all tetrahedra at faces that are not locally Delaunay. Borrowed from `mesh`. Empty for NULL.
 */
DELOTET_API
struct DelotetIndicesView delotet_mesh_replaced_tets(const struct DelotetMesh *mesh);

/**
 * Attributes of all points: #points by `width` doubles. Input points have the input's; Steiner points on an input edge are interpolated
 * linearly between its ends, those inside linearly in a tetrahedron of surrounding points.
 * Borrowed from `mesh`. Empty for NULL and if the input has none.
 */
DELOTET_API
struct DelotetDoublesView delotet_mesh_point_attributes(const struct DelotetMesh *mesh);

/**
 * Markers of all points. Input points have the input's; Steiner points have that of their segment, or 0 if they lie on no segment.
 * Borrowed from `mesh`. Empty for NULL and if the input has none.
 */
DELOTET_API
struct DelotetMarkersView delotet_mesh_point_markers(const struct DelotetMesh *mesh);

/**
 * The tetrahedra: four corners each, positively oriented, det(b - a, c - a, d - a) > 0, as in VTK, Gmsh and TetGen's output. Borrowed from
 * `mesh`. Empty for NULL.
 */
DELOTET_API
struct DelotetTetsView delotet_mesh_tets(const struct DelotetMesh *mesh);

/**
 * The neighbours: for each tetrahedron and corner i the tetrahedron across the face opposite that corner, or DELOTET_INVALID_INDEX if
 * there is none. Borrowed from `mesh`. Empty for NULL.
 */
DELOTET_API
struct DelotetTetsView delotet_mesh_neighbors(const struct DelotetMesh *mesh);

/**
 * For each tetrahedron the index of its region in delotet_mesh_regions(). Borrowed from `mesh`. Empty for NULL.
 */
DELOTET_API
struct DelotetIndicesView delotet_mesh_tet_regions(const struct DelotetMesh *mesh);

/**
 * The regions. Borrowed from `mesh`. Empty for NULL.
 */
DELOTET_API struct DelotetRegionsView delotet_mesh_regions(const struct DelotetMesh *mesh);

/**
 * The faces on facets, with facet, marker and both tetrahedra. Pieces of facets that bound no tetrahedron are in
 * delotet_mesh_unmeshed_subfaces(). Borrowed from `mesh`. Empty for NULL.
 */
DELOTET_API
struct DelotetSubfacesView delotet_mesh_subfaces(const struct DelotetMesh *mesh);

/**
 * The mesh edges on segments and on facet edges, with segment and marker. Borrowed from `mesh`. Empty for NULL.
 */
DELOTET_API
struct DelotetSubsegmentsView delotet_mesh_subsegments(const struct DelotetMesh *mesh);

/**
 * Pieces of facets that bound no tetrahedron because everything around them was carved: a shell that leaks, a facet outside the domain, a
 * wall in a hole. They are not faces of the mesh: both tetrahedra are DELOTET_INVALID_INDEX. Borrowed from `mesh`. Empty for NULL.
 */
DELOTET_API
struct DelotetSubfacesView delotet_mesh_unmeshed_subfaces(const struct DelotetMesh *mesh);

/**
 * Pieces of segments and of facet edges that are edges of no tetrahedron. Borrowed from `mesh`. Empty for NULL.
 */
DELOTET_API
struct DelotetSubsegmentsView delotet_mesh_unmeshed_subsegments(const struct DelotetMesh *mesh);

/**
 * Points that belong to no tetrahedron, in ascending order: those that equal an earlier point (delotet_mesh_point_aliases()), those
 * around which everything was carved, and those that weights hide (delotet_mesh_hidden_points()). Borrowed from `mesh`. Empty for NULL.
 */
DELOTET_API
struct DelotetIndicesView delotet_mesh_unmeshed_points(const struct DelotetMesh *mesh);

/**
 * The Steiner points, in the order of delotet_mesh_points(), with the input edge and the segment that each lies on, if any. Borrowed from
 * `mesh`. Empty for NULL.
 */
DELOTET_API
struct DelotetSteinerView delotet_mesh_steiner_points(const struct DelotetMesh *mesh);

/**
 * Further terms of parameters that one double cannot hold (segments about an ulp apart), in the order of the Steiner points, each point's
 * largest term first. Borrowed from `mesh`. Empty for NULL.
 */
DELOTET_API
struct DelotetSteinerTermsView delotet_mesh_steiner_terms(const struct DelotetMesh *mesh);

/**
 * The flips that facet merging made, in order (see delotet_options_set_merge_facets). Borrowed from `mesh`. Empty for NULL.
 */
DELOTET_API
struct DelotetFacetFlipsView delotet_mesh_facet_flips(const struct DelotetMesh *mesh);

/**
 * Counts and costs of the run. Set `stats->struct_size = sizeof *stats` before the call.
 * Errors: INVALID_ARGUMENT (NULL, or a `struct_size` smaller than that field itself).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_stats(const struct DelotetMesh *mesh,
                                      struct DelotetStats *stats,
                                      struct DelotetError **out_error);

/**
 * Checks a mesh against its PLC exactly: all tetrahedra are positive and conforming, points are unmoved, segments and facets are covered;
 * with `constrained_delaunay` also that every unconstrained face is locally Delaunay. A facet without any subfaces in the mesh is a
 * defect, unless the mesh was made in mode DELOTET_MODE_DELAUNAY: then facets and segments are not checked. The error lists at most
 * `max_defects`.
 * Errors: INVALID_ARGUMENT, CHECK_FAILED, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_check(const struct DelotetMesh *mesh,
                                      const struct DelotetPlc *plc,
                                      bool constrained_delaunay,
                                      size_t max_defects,
                                      struct DelotetError **out_error);

/**
 * Checks a mesh like delotet_mesh_check() without the Delaunay property, and also that it keeps the surface as DELOTET_MODE_PRESERVE
 * promises: every input triangle is a face (or, if input points lie on it, a union of faces with these as corners), every polygon is a
 * union of faces and every segment one of edges between input points, and no added point lies on a facet or segment. This is checked
 * whatever the mode of the mesh. The error lists at most `max_defects`. Errors: INVALID_ARGUMENT, CHECK_FAILED, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_check_preserved(const struct DelotetMesh *mesh,
                                                const struct DelotetPlc *plc,
                                                size_t max_defects,
                                                struct DelotetError **out_error);

/**
 * Checks a mesh like delotet_mesh_check_preserved(), but only its outer boundary, as DELOTET_PRESERVE_OUTER promises: other facets and
 * segments must be covered and may carry added points. The error lists at most `max_defects`.
 * Errors: INVALID_ARGUMENT, CHECK_FAILED, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_check_preserved_outer(const struct DelotetMesh *mesh,
                                                      const struct DelotetPlc *plc,
                                                      size_t max_defects,
                                                      struct DelotetError **out_error);

/**
 * Frees a mesh and everything borrowed from it. NULL is ignored.
 */
DELOTET_API void delotet_mesh_free(struct DelotetMesh *mesh);

/**
 * Sets the weights of all points, replacing earlier weights or heights: DELOTET_MODE_DELAUNAY then makes the weighted Delaunay (regular)
 * tetrahedralization, in which of two points the one with the smaller power distance, squared distance minus weight, is the nearer one. A
 * point may be hidden by others: it belongs to no tetrahedron (delotet_mesh_hidden_points()). Equal points count as one with the largest of
 * their weights; equal weights change nothing. Signs are exact for the weights as they are given. One thread inserts weighted points.
 * `weights`: `count` finite doubles of any sign, in the square of the unit of coordinates; copied. `count`: the number of points, or 0,
 * which removes weights and heights. Points added later have the weight 0.
 * delotet_tetrahedralize() fails with INVALID_ARGUMENT if the PLC has facets or segments as well, or in another mode, and with
 * COORDINATE_RANGE if a weight is too far from the squares of the coordinates. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_set_point_weights(struct DelotetPlc *plc,
                                                 const double *weights,
                                                 size_t count,
                                                 struct DelotetError **out_error);

/**
 * Sets the heights to which all points are lifted in the fourth dimension, instead of weights (delotet_plc_set_point_weights()) and with
 * the same effect: the height h stands for the weight x² + y² + z² - h, exactly. Of equal points the smallest height counts.
 * `heights`: `count` finite doubles; copied. `count`: the number of points, or 0, which removes weights and heights. Points added later
 * have the height 0. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_set_point_heights(struct DelotetPlc *plc,
                                                 const double *heights,
                                                 size_t count,
                                                 struct DelotetError **out_error);

/**
 * The weights or heights of the points: one per point, or none at all. Borrowed from `plc`: valid until it is changed or freed. Empty for
 * NULL.
 */
DELOTET_API
struct DelotetDoublesView delotet_plc_point_weights(const struct DelotetPlc *plc);

/**
 * Points that others hide by their weights, in ascending order: they belong to no tetrahedron, and are among
 * delotet_mesh_unmeshed_points(). Borrowed from `mesh`. Empty for NULL, without weights, and with
 * delotet_options_set_drop_unmeshed_points(): delotet_mesh_point_map() then tells which are left out.
 */
DELOTET_API struct DelotetIndicesView delotet_mesh_hidden_points(const struct DelotetMesh *mesh);

/**
 * The weights or heights of the points that counted, in the order of delotet_mesh_points(): one per point. Of equal points the first has the
 * value that counts for all. Borrowed from `mesh`. Empty for NULL and without weights.
 */
DELOTET_API
struct DelotetDoublesView delotet_mesh_point_weights(const struct DelotetMesh *mesh);

/**
 * The warnings about a mesh: leaks, parts of the input that are not meshed, seeds without effect. Lists at most as many of each kind as
 * delotet_options_set_max_defects() allows; delotet_mesh_warning_count() counts all. The log gets a line per kind. Borrowed from `mesh`.
 * Empty for NULL.
 */
DELOTET_API
struct DelotetWarningsView delotet_mesh_warnings(const struct DelotetMesh *mesh);

/**
 * The number of warnings of a kind (a DelotetWarningKind), listed or not. 0 for NULL and for unknown kinds.
 */
DELOTET_API uint64_t delotet_mesh_warning_count(const struct DelotetMesh *mesh, uint32_t kind);

/**
 * Makes the mesh of a PLC.
 * `options`: NULL for the defaults. `out_mesh`: the mesh, owned by the caller; free it with delotet_mesh_free(). NULL on failure. It does
 * not refer to `plc` or `options`. `out_error`: may be NULL; receives NULL on success, otherwise an error that lists the elements at
 * fault, to be freed with delotet_error_free().
 * The same input and options give the same mesh, bit for bit. The calling thread needs little stack: 256 KiB suffice.
 * Errors: INVALID_ARGUMENT, the statuses from 10 to 41, INTERNAL.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_tetrahedralize(const struct DelotetPlc *plc,
                                          const struct DelotetOptions *options,
                                          struct DelotetMesh **out_mesh,
                                          struct DelotetError **out_error);

/**
 * Makes a mesh of arrays: one made elsewhere, or in an earlier run. All arrays are copied.
 * `xyz`: #points by 3 doubles. `input_point_count`: how many of them are input points, at most `point_count`: these keep their place in
 * every later mesh. The others may be moved and taken out later, but only those behind the last point that is on a kept face or edge: up
 * to that one all count as input points.
 * `tets`: #tetrahedra by 4 corners, in either orientation. `attributes`: NULL, or one double per tetrahedron; equal ones are one material.
 * `faces`: #faces by 3 corners, faces of the mesh that are to be kept; may be NULL if `face_count` is 0. Those on the boundary and between
 * different attributes are kept in any case, with marker 0. `face_markers`: NULL, or one per face.
 * `edges`: #edges by 2 ends, edges of the mesh that are to be kept; may be NULL if `edge_count` is 0. `edge_markers`: NULL, or one per edge.
 * `options`: NULL, or options whose limits count, and how many defects an error lists.
 * `out_mesh`: the mesh, owned by the caller; free it with delotet_mesh_free(). NULL on failure. The facet of a subface is the index of the
 * given face (others are numbered after them), the segment of a subsegment that of the given edge. Of equal points tetrahedra use the first.
 * Errors: INVALID_ARGUMENT (also without tetrahedra, and for attributes that are not finite), NON_FINITE_POINT, COORDINATE_RANGE,
 * INDEX_OUT_OF_RANGE; CHECK_FAILED: a tetrahedron is flat, a face belongs to more than two tetrahedra or to two on one side, tetrahedra with
 * a common edge overlap, a given face or edge is none of the mesh; CANCELLED, TIME_LIMIT, MEMORY_LIMIT, TOO_LARGE, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_from_arrays(const double *xyz,
                                            size_t point_count,
                                            size_t input_point_count,
                                            const uint32_t *tets,
                                            size_t tet_count,
                                            const double *attributes,
                                            const uint32_t *faces,
                                            size_t face_count,
                                            const int32_t *face_markers,
                                            const uint32_t *edges,
                                            size_t edge_count,
                                            const int32_t *edge_markers,
                                            const struct DelotetOptions *options,
                                            struct DelotetMesh **out_mesh,
                                            struct DelotetError **out_error);

/**
 * Reads a mesh from a file; the extension determines the format: .ele (with .node, and .face and .edge if they are there), .vtu (with
 * STEM_subfaces.vtu if it is there), .msh, .mesh (src/doc/formats.md says what is read). It becomes a mesh as in
 * delotet_mesh_from_arrays(); all its points are input points. Attributes and markers of points are read where the format has them.
 * `path`: zero-terminated; any bytes on Unix, UTF-8 elsewhere. `options`: NULL, or options whose limits count. `out_mesh`: the mesh, owned
 * by the caller; free it with delotet_mesh_free(). NULL on failure.
 * Errors: as delotet_mesh_from_arrays(); UNSUPPORTED (unknown format, or the library was built without file formats), FILE, FORMAT.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_read(const char *path,
                                     const struct DelotetOptions *options,
                                     struct DelotetMesh **out_mesh,
                                     struct DelotetError **out_error);

/**
 * Refines a mesh, one of delotet_tetrahedralize() or any other: adds points inside until sizes, volumes and shapes are as wanted, then
 * optimises if the options say so. Kept are subfaces and subsegments with facets, segments and markers, the regions, the input points, and
 * points of earlier runs on edges and facets, all in their order. Points inside of earlier runs come behind them, with the new ones; they may
 * have moved or gone. Surfaces are not refined: near a coarse one sizes are bounded by it. Of a mesh made with
 * delotet_options_set_drop_unmeshed_points() the remaining points count as the input.
 * `sizes`: NULL, or lengths wanted in this mesh. `options`: NULL for the defaults; those about filling (delotet_options_set_size() and what
 * follows it, in any mode), optimisation, limits and callbacks count. `out_mesh`: another mesh, owned by the caller; free it with
 * delotet_mesh_free(). NULL on failure. It does not refer to the other handles. Attributes of points are interpolated at new ones.
 * The same mesh, sizes and options give the same result, bit for bit.
 * Errors: INVALID_ARGUMENT (also for sizes of another mesh), CHECK_FAILED (the mesh has no valid doubles, as with
 * delotet_options_set_exact_form()), COORDINATE_RANGE, CANCELLED, STEINER_LIMIT, TETRAHEDRA_LIMIT, TIME_LIMIT,
 * MEMORY_LIMIT, TOO_LARGE, OUT_OF_MEMORY, INTERNAL.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_refine(const struct DelotetMesh *mesh,
                                       const struct DelotetMeshSizes *sizes,
                                       const struct DelotetOptions *options,
                                       struct DelotetMesh **out_mesh,
                                       struct DelotetError **out_error);

/**
 * Improves the dihedral angles of a mesh, with the effort of delotet_options_set_optimize(), but at least 1, or for the seconds of
 * delotet_options_set_optimize_seconds(). The worst tetrahedron never gets worse. Kept is what delotet_mesh_refine() keeps: points inside of
 * earlier runs may move and go, and new ones may come.
 * `options`, `out_mesh`, errors: as for delotet_mesh_refine(); of the options those about sizes and shapes do not count.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_improve(const struct DelotetMesh *mesh,
                                        const struct DelotetOptions *options,
                                        struct DelotetMesh **out_mesh,
                                        struct DelotetError **out_error);

/**
 * Sizes without a wish. The caller owns them; free them with delotet_mesh_sizes_free(). NULL only if memory ran out.
 */
DELOTET_API
DELOTET_MUST_USE
struct DelotetMeshSizes *delotet_mesh_sizes_new(void);

/**
 * Sets the edge length wanted at each point of the mesh, replacing earlier ones. The smallest of all sizes counts, and they grow between the
 * points by the gradation (delotet_options_set_gradation()).
 * `sizes`: one per point, positive, infinite where there is no wish; copied; may be NULL if `count` is 0. `count`: the number of points of
 * the mesh that will be refined, or 0, which removes all. Errors: INVALID_ARGUMENT (a size is NaN or not positive; the number is compared
 * by delotet_mesh_refine()), OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_sizes_set_points(struct DelotetMeshSizes *sizes,
                                                 const double *lengths,
                                                 size_t count,
                                                 struct DelotetError **out_error);

/**
 * Sets the edge length wanted in each tetrahedron of the mesh, replacing earlier ones: a point gets the smallest of those around it.
 * Otherwise as delotet_mesh_sizes_set_points(), with `count` the number of tetrahedra.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_sizes_set_tets(struct DelotetMeshSizes *sizes,
                                               const double *lengths,
                                               size_t count,
                                               struct DelotetError **out_error);

/**
 * Sets the edge length wanted at the subfaces with a marker, replacing an earlier one. `length`: positive; infinite removes it. Errors:
 * INVALID_ARGUMENT, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_sizes_set_facet(struct DelotetMeshSizes *sizes,
                                                int32_t marker,
                                                double length,
                                                struct DelotetError **out_error);

/**
 * Sets the area wanted of the subfaces with a marker, replacing an earlier one: the edge of the equilateral triangle of this area is wanted
 * there, unless the length is smaller. (Subfaces stay.) `area`: positive; infinite removes it. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_sizes_set_facet_area(struct DelotetMeshSizes *sizes,
                                                     int32_t marker,
                                                     double area,
                                                     struct DelotetError **out_error);

/**
 * Sets the edge length wanted at the subsegments with a marker; otherwise as delotet_mesh_sizes_set_facet().
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_sizes_set_segment(struct DelotetMeshSizes *sizes,
                                                  int32_t marker,
                                                  double length,
                                                  struct DelotetError **out_error);

/**
 * Sets the edge length wanted in the regions with an attribute; otherwise as delotet_mesh_sizes_set_facet(). Errors: INVALID_ARGUMENT (also
 * for an attribute that is NaN), OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_sizes_set_region(struct DelotetMeshSizes *sizes,
                                                 double attribute,
                                                 double length,
                                                 struct DelotetError **out_error);

/**
 * Frees sizes. NULL is ignored.
 */
DELOTET_API void delotet_mesh_sizes_free(struct DelotetMeshSizes *sizes);

/**
 * The region attribute of each tetrahedron: #tetrahedra by 1. Computed on first use; borrowed from `mesh`, valid until it is freed.
 * Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_tet_attributes(const struct DelotetMesh *mesh,
                                               struct DelotetDoublesView *out_view,
                                               struct DelotetError **out_error);

/**
 * For each point the first tetrahedron that has it as a corner, or DELOTET_INVALID_INDEX if there is none. Computed on first use; borrowed
 * from `mesh`. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_point_tets(const struct DelotetMesh *mesh,
                                           struct DelotetIndicesView *out_view,
                                           struct DelotetError **out_error);

/**
 * All faces, each once; delotet_mesh_subfaces() has only the constrained ones. Computed on first use; borrowed from `mesh`.
 * Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_faces(const struct DelotetMesh *mesh,
                                      struct DelotetFacesView *out_view,
                                      struct DelotetError **out_error);

/**
 * For each tetrahedron its four faces (indices into delotet_mesh_faces()), face i opposite corner i. Computed on first use; borrowed from
 * `mesh`. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_tet_faces(const struct DelotetMesh *mesh,
                                          struct DelotetTetsView *out_view,
                                          struct DelotetError **out_error);

/**
 * All edges, each once, sorted by their ends; delotet_mesh_subsegments() has only the constrained ones. Computed on first use; borrowed
 * from `mesh`. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY, TOO_LARGE.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_edges(const struct DelotetMesh *mesh,
                                      struct DelotetEdgesView *out_view,
                                      struct DelotetError **out_error);

/**
 * For each tetrahedron its edges 01 02 03 12 13 23 (indices into delotet_mesh_edges()): #tetrahedra by 6. Computed on first use; borrowed
 * from `mesh`. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY, TOO_LARGE.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_tet_edges(const struct DelotetMesh *mesh,
                                          struct DelotetIndexRowsView *out_view,
                                          struct DelotetError **out_error);

/**
 * For each subface (a, b, c) its edges ab bc ca (indices into delotet_mesh_edges()): #subfaces by 3. In a second-order mesh the node on
 * edge i has the index #points + i. Computed on first use; borrowed from `mesh`. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY, TOO_LARGE.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_subface_edges(const struct DelotetMesh *mesh,
                                              struct DelotetIndexRowsView *out_view,
                                              struct DelotetError **out_error);

/**
 * Second-order tetrahedra: a node at the midpoint of every edge (rounded to doubles), shared by all tetrahedra around it. `node_order`: a
 * DELOTET_NODE_ORDER_ constant. Computed on first use; borrowed from `mesh`.
 * Errors: INVALID_ARGUMENT, OUT_OF_MEMORY, TOO_LARGE.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_second_order(const struct DelotetMesh *mesh,
                                             DelotetNodeOrder node_order,
                                             struct DelotetSecondOrderView *out_view,
                                             struct DelotetError **out_error);

/**
 * Finds the tetrahedra that contain points, exactly. A point on a shared face, edge or corner belongs to the tetrahedron with the smallest
 * index.
 * `xyz`: #points by 3 doubles. `out_tets`: room for #points indices; receives DELOTET_INVALID_INDEX for points outside the mesh and points
 * that are not finite. `out_barycentric`: NULL, or room for #points by 4 doubles; receives the barycentric coordinates in that
 * tetrahedron, none negative, with sum 1 up to rounding; NaN outside. A linear field at the point is the sum of each coordinate times the
 * value at its corner. The search tree is built on first use and kept: about 40 bytes per tetrahedron.
 * Errors: INVALID_ARGUMENT, OUT_OF_MEMORY; then nothing was written.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_locate(const struct DelotetMesh *mesh,
                                       const double *xyz,
                                       size_t point_count,
                                       uint32_t *out_tets,
                                       double *out_barycentric,
                                       struct DelotetError **out_error);

/**
 * The measures of every tetrahedron, in the order of delotet_mesh_tets(): dihedral angles (6 doubles), radius-edge ratio, mean ratio,
 * volume. Computed on first use, in 72 bytes per tetrahedron; borrowed from `mesh`, valid until it is freed. The relative error of
 * a measure is below 1e-8 (usually 1e-14), also for the flattest tetrahedra; the bits are the same on all platforms and do not depend on
 * the order of points or corners. Nothing traps, whatever the size of the coordinates.
 * Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_quality(const struct DelotetMesh *mesh,
                                        struct DelotetTetQualitiesView *out_view,
                                        struct DelotetError **out_error);

/**
 * Worst values and histograms, of all tetrahedra and of those that are not input-forced. Set `summary->struct_size = sizeof *summary`
 * before the call. Computed on first use, without memory per tetrahedron.
 * Errors: INVALID_ARGUMENT (NULL, or a `struct_size` smaller than that field itself), OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_quality_summary(const struct DelotetMesh *mesh,
                                                struct DelotetQualitySummary *summary,
                                                struct DelotetError **out_error);

/**
 * The worst tetrahedra by a measure, the worst first; of equally bad ones the smaller index.
 * `measure`: a DELOTET_QUALITY_ constant. `unforced`: leave out those that are input-forced. `out_tets`: room for `count` indices; receives
 * DELOTET_INVALID_INDEX where there are no more tetrahedra.
 * Errors: INVALID_ARGUMENT, OUT_OF_MEMORY; then nothing was written.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_worst_tets(const struct DelotetMesh *mesh,
                                           DelotetQualityMeasure measure,
                                           bool unforced,
                                           uint32_t *out_tets,
                                           size_t count,
                                           struct DelotetError **out_error);

/**
 * The input-forced tetrahedra, in ascending order, with the facets at fault. A tetrahedron is input-forced if it lies in a wedge
 * of less than DELOTET_QUALITY_FORCED_BELOW degrees: between two subfaces that meet at an edge of the mesh, among the tetrahedra that one
 * passes from one to the other around that edge without crossing a third. Their dihedral angles there add up to the angle of the
 * wedge, so every mesh of this input has an angle of at most that all along the edge. Computed on first use; borrowed from `mesh`, valid
 * until it is freed. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_forced_tets(const struct DelotetMesh *mesh,
                                            struct DelotetForcedTetsView *out_view,
                                            struct DelotetError **out_error);

/**
 * The bounds of the bins of a measure's histogram, ascending: DELOTET_QUALITY_BINS + 1 doubles. Bin i has the values from bound i
 * (inclusive) to bound i + 1 (exclusive), the last one all from bound DELOTET_QUALITY_BINS - 1 on. Static. Empty for other measures.
 */
DELOTET_API
struct DelotetDoublesView delotet_quality_bin_edges(DelotetQualityMeasure measure);

/**
 * The name of a bin of a measure's histogram in words, such as "10 to 15", "below 1" or "from 60"; "unknown" for other measures and bins.
 * Static: never NULL, never freed.
 */
DELOTET_API
const char *delotet_quality_bin_name(DelotetQualityMeasure measure,
                                     size_t bin);

/**
 * Name of a measure, such as "DELOTET_QUALITY_ETA"; "unknown" for other numbers. Static: never NULL, never freed.
 */
DELOTET_API
const char *delotet_quality_measure_name(DelotetQualityMeasure measure);

/**
 * Finds the tetrahedra whose circumradius is more than `ratio` of their shortest edge, and for each whether the input forces it.
 * `ratio`: positive and finite; 0 is the ratio that was asked for (delotet_options_set_quality()), or 2 if none was, as in meshes that were
 * read. `out_tets`: the list, owned by the caller, which needs the mesh no longer; free it with delotet_skinny_tets_free(). NULL on failure.
 * Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_skinny_tets_new(const struct DelotetMesh *mesh,
                                           double ratio,
                                           struct DelotetSkinnyTets **out_tets,
                                           struct DelotetError **out_error);

/**
 * All of them, in ascending order. Borrowed from `tets`. Empty for NULL.
 */
DELOTET_API struct DelotetSkinnyTetsView delotet_skinny_tets_view(const struct DelotetSkinnyTets *tets);

/**
 * The ratio that they are above. 0 for NULL.
 */
DELOTET_API double delotet_skinny_tets_ratio(const struct DelotetSkinnyTets *tets);

/**
 * Frees a list. NULL is ignored.
 */
DELOTET_API void delotet_skinny_tets_free(struct DelotetSkinnyTets *tets);

/**
 * Name of a cause, such as "DELOTET_SKINNY_WEDGE"; "unknown" for other numbers. Static: never NULL, never freed.
 */
DELOTET_API
const char *delotet_skinny_cause_name(DelotetSkinnyCause cause);

/**
 * Makes the Voronoi diagram of a mesh made in DELOTET_MODE_DELAUNAY; with weights of points (delotet_plc_set_point_weights()) the power
 * diagram. It is the dual of the mesh as it is: a vertex per tetrahedron, an edge per face (delotet_mesh_faces()), a facet per edge
 * (delotet_mesh_edges()), a cell per point, in the same order. Five and more cospherical points have several vertices at the same place,
 * and edges and facets of no extent between them.
 * `options`: NULL, or options whose limits and token end it; nothing else of them counts. `out_voronoi`: the diagram, owned by the caller,
 * which needs the mesh no longer; free it with delotet_voronoi_free(). NULL on failure.
 * Errors: INVALID_ARGUMENT, UNSUPPORTED (another mesh; a weighted one whose weights are not known, as read from files), COORDINATE_RANGE,
 * CANCELLED, TIME_LIMIT, MEMORY_LIMIT, TOO_LARGE, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_voronoi_new(const struct DelotetMesh *mesh,
                                       const struct DelotetOptions *options,
                                       struct DelotetVoronoi **out_voronoi,
                                       struct DelotetError **out_error);

/**
 * The vertices: for each tetrahedron the centre of the sphere through its corners (with weights: the point of equal power distances), each
 * coordinate the double nearest to the exact one; infinite where the centre of a nearly flat tetrahedron is beyond the range of doubles.
 * Borrowed from `voronoi`. Empty for NULL.
 */
DELOTET_API
struct DelotetPointsView delotet_voronoi_vertices(const struct DelotetVoronoi *voronoi);

/**
 * The edges, one per face of the mesh. Borrowed from `voronoi`. Empty for NULL.
 */
DELOTET_API struct DelotetVoronoiEdgesView delotet_voronoi_edges(const struct DelotetVoronoi *voronoi);

/**
 * The facets, one per edge of the mesh. Borrowed from `voronoi`. Empty for NULL.
 */
DELOTET_API struct DelotetVoronoiFacetsView delotet_voronoi_facets(const struct DelotetVoronoi *voronoi);

/**
 * The edges of all facets, one facet after the other. Borrowed from `voronoi`. Empty for NULL.
 */
DELOTET_API struct DelotetIndicesView delotet_voronoi_facet_edges(const struct DelotetVoronoi *voronoi);

/**
 * The cells, one per point of the mesh. Borrowed from `voronoi`. Empty for NULL.
 */
DELOTET_API struct DelotetVoronoiCellsView delotet_voronoi_cells(const struct DelotetVoronoi *voronoi);

/**
 * The facets of all cells, one cell after the other. Borrowed from `voronoi`. Empty for NULL.
 */
DELOTET_API struct DelotetIndicesView delotet_voronoi_cell_facets(const struct DelotetVoronoi *voronoi);

/**
 * Frees a diagram and everything borrowed from it. NULL is ignored.
 */
DELOTET_API void delotet_voronoi_free(struct DelotetVoronoi *voronoi);

/**
 * Reads a PLC from a file; the extension determines the format (src/doc/formats.md lists them).
 * `path`: zero-terminated; any bytes on Unix, UTF-8 elsewhere. `out_plc`: the PLC, owned by the caller; free it with delotet_plc_free().
 * NULL on failure.
 * Errors: INVALID_ARGUMENT, UNSUPPORTED (unknown format, or the library was built without file formats), FILE, FORMAT,
 * INDEX_OUT_OF_RANGE, TOO_LARGE, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_read(const char *path,
                                    struct DelotetPlc **out_plc,
                                    struct DelotetError **out_error);

/**
 * Reads a PLC like delotet_plc_read(), under the limits of `options` (NULL: none), of which the others have no effect.
 * Errors: as delotet_plc_read(); CANCELLED, TIME_LIMIT, MEMORY_LIMIT.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_read_with(const char *path,
                                         const struct DelotetOptions *options,
                                         struct DelotetPlc **out_plc,
                                         struct DelotetError **out_error);

/**
 * Writes a PLC to a file; the extension determines the format (src/doc/formats.md lists the surface formats). Values that the format
 * cannot hold are lost without a warning; delotet_plc_write_with() reports them.
 * Errors: INVALID_ARGUMENT, UNSUPPORTED (unknown format, one that cannot hold the contents of the PLC, or the library was built without
 * file formats), NON_FINITE_POINT, FILE, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_write(const struct DelotetPlc *plc,
                                     const char *path,
                                     struct DelotetError **out_error);

/**
 * Writes a mesh to a file; the extension determines the format (src/doc/formats.md lists them). `plc` is the PLC that the mesh was made
 * from: some formats store its markers and attributes. For a mesh of delotet_mesh_from_arrays() or delotet_mesh_read(), and what was made
 * of it, any PLC will do: one with the input points' markers and attributes, or an empty one. Values that the format cannot hold are lost without a warning;
 * delotet_mesh_write_with() reports them.
 * Errors: INVALID_ARGUMENT, UNSUPPORTED (unknown format, or the library was built without file formats), FILE, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_write(const struct DelotetMesh *mesh,
                                      const struct DelotetPlc *plc,
                                      const char *path,
                                      struct DelotetError **out_error);

/**
 * New options with the defaults that the setters document. The caller owns them; free them with delotet_write_options_free(). NULL only if
 * memory ran out.
 */
DELOTET_API
DELOTET_MUST_USE
struct DelotetWriteOptions *delotet_write_options_new(void);

/**
 * .vtu: compress the arrays with zlib, which makes smaller files more slowly. Other formats ignore it. Default: false. Errors:
 * INVALID_ARGUMENT (NULL).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_write_options_set_compress(struct DelotetWriteOptions *options,
                                                      bool compress,
                                                      struct DelotetError **out_error);

/**
 * .vtu: also write the subfaces, to STEM_subfaces.vtu for STEM.vtu. Other formats ignore it: they always contain the subfaces, except
 * .vtk, which never does. Default: false. Errors: INVALID_ARGUMENT (NULL).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_write_options_set_subfaces(struct DelotetWriteOptions *options,
                                                      bool subfaces,
                                                      struct DelotetError **out_error);

/**
 * .vtu: also write the quality of each tetrahedron, as delotet_mesh_quality() has it: arrays max_dihedral, radius_edge, eta and volume of
 * doubles beside min_dihedral, which is always written. Other formats ignore it. Default: false. Errors: INVALID_ARGUMENT (NULL).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_write_options_set_quality_data(struct DelotetWriteOptions *options,
                                                          bool quality_data,
                                                          struct DelotetError **out_error);

/**
 * Write tetrahedra of ten nodes: the corners, then the midpoints of the edges in the order of the format. Writing .mesh then fails.
 * Default: false. Errors: INVALID_ARGUMENT (NULL).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_write_options_set_second_order(struct DelotetWriteOptions *options,
                                                          bool second_order,
                                                          struct DelotetError **out_error);

/**
 * .msh: sets the version, a DELOTET_MSH_ constant. Other formats ignore it. Default: DELOTET_MSH_4_1. Errors: INVALID_ARGUMENT (other
 * values).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_write_options_set_msh_version(struct DelotetWriteOptions *options,
                                                         DelotetMshVersion version,
                                                         struct DelotetError **out_error);

/**
 * .msh, .inp: names the regions with an attribute; other formats ignore it. `name`: zero-terminated UTF-8; its first line is copied; NULL
 * or "" removes the name. Default: no names.
 * Errors: INVALID_ARGUMENT (NULL, an attribute that is not finite, a name that is not UTF-8), OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_write_options_set_region_name(struct DelotetWriteOptions *options,
                                                         double attribute,
                                                         const char *name,
                                                         struct DelotetError **out_error);

/**
 * Sets the callback that receives log lines; `user_data` is passed to it unchanged. There is one line "warning: ..." for each kind of data
 * that the format cannot hold and for each option without effect in it. NULL, the default: none.
 * Errors: INVALID_ARGUMENT (options is NULL).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_write_options_set_log(struct DelotetWriteOptions *options,
                                                 DelotetLogFn callback,
                                                 void *user_data,
                                                 struct DelotetError **out_error);

/**
 * Sets the token that cancels writing: nothing is left behind then. NULL, the default: none. Errors: INVALID_ARGUMENT (options is NULL).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_write_options_set_cancel_token(struct DelotetWriteOptions *options,
                                                          const struct DelotetCancelToken *token,
                                                          struct DelotetError **out_error);

/**
 * Fail with DELOTET_STATUS_TIME_LIMIT this many seconds after the beginning of a call; nothing is left behind then. 0, the default: no
 * limit. Errors: INVALID_ARGUMENT (negative or not finite).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_write_options_set_time_limit(struct DelotetWriteOptions *options,
                                                        double seconds,
                                                        struct DelotetError **out_error);

/**
 * Whether arrays are compressed, as set by delotet_write_options_set_compress(). All getters return the default for NULL.
 */
DELOTET_API
bool delotet_write_options_compress(const struct DelotetWriteOptions *options);

/**
 * Whether subfaces are also written, as set by delotet_write_options_set_subfaces().
 */
DELOTET_API bool delotet_write_options_subfaces(const struct DelotetWriteOptions *options);

/**
 * Whether the quality of tetrahedra is also written, as set by delotet_write_options_set_quality_data().
 */
DELOTET_API bool delotet_write_options_quality_data(const struct DelotetWriteOptions *options);

/**
 * Whether tetrahedra have ten nodes, as set by delotet_write_options_set_second_order().
 */
DELOTET_API bool delotet_write_options_second_order(const struct DelotetWriteOptions *options);

/**
 * The version of .msh, as set by delotet_write_options_set_msh_version().
 */
DELOTET_API DelotetMshVersion delotet_write_options_msh_version(const struct DelotetWriteOptions *options);

/**
 * The name of the regions with an attribute, UTF-8; NULL if they have none. Borrowed from `options`: valid until they are changed or
 * freed.
 */
DELOTET_API
const char *delotet_write_options_region_name(const struct DelotetWriteOptions *options,
                                              double attribute);

/**
 * The log callback, NULL if there is none, as set by delotet_write_options_set_log().
 * `out_user_data`: NULL, or receives the pointer that was set with it (NULL without a callback).
 */
DELOTET_API
DelotetLogFn delotet_write_options_log(const struct DelotetWriteOptions *options,
                                       void **out_user_data);

/**
 * The token, NULL if there is none, as set by delotet_write_options_set_cancel_token(). Borrowed from `options`: valid until they get
 * another one or are freed.
 */
DELOTET_API
const struct DelotetCancelToken *delotet_write_options_cancel_token(const struct DelotetWriteOptions *options);

/**
 * The limit on time in seconds, 0 if there is none, as set by delotet_write_options_set_time_limit().
 */
DELOTET_API double delotet_write_options_time_limit(const struct DelotetWriteOptions *options);

/**
 * Frees options. NULL is ignored. No call may be using them.
 */
DELOTET_API void delotet_write_options_free(struct DelotetWriteOptions *options);

/**
 * Writes a mesh to a file like delotet_mesh_write(), with `options` (NULL: the defaults). The log callback is told what the format cannot
 * hold; src/doc/formats.md says what each format holds.
 * Errors: INVALID_ARGUMENT, UNSUPPORTED (unknown format, one without second order, or the library was built without file formats), FILE,
 * TOO_LARGE, CANCELLED, TIME_LIMIT, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_write_with(const struct DelotetMesh *mesh,
                                           const struct DelotetPlc *plc,
                                           const char *path,
                                           const struct DelotetWriteOptions *options,
                                           struct DelotetError **out_error);

/**
 * Writes a PLC to a file like delotet_plc_write(), and reports values that the format cannot hold to the log callback of `options` (NULL:
 * no callback). The other options have no effect on surface formats; the log names those that are set.
 * Errors: INVALID_ARGUMENT, UNSUPPORTED (unknown format, one that cannot hold the contents of the PLC, or the library was built without
 * file formats), NON_FINITE_POINT, FILE, CANCELLED, TIME_LIMIT, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_write_with(const struct DelotetPlc *plc,
                                          const char *path,
                                          const struct DelotetWriteOptions *options,
                                          struct DelotetError **out_error);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* DELOTET_DELOTET_H */
