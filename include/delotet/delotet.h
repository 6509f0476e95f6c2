/* delotet: exact constrained Delaunay tetrahedralization. C API. MIT OR Apache-2.0.
 *
 * Generated from src/ffi by capi-tests/header.rs. Do not edit: run UPDATE_HEADER=1 cargo test --test header.
 *
 * Objects: DelotetPlc is the input, DelotetOptions the settings, DelotetMesh the result, DelotetError a failure. Whoever got one
 * through an out-parameter or from _new owns it and frees it with the _free function of its type; free(NULL) is allowed.
 *
 * Failures: every function that can fail returns a DelotetStatus, 0 on success. If its last argument `out_error` is not NULL, it
 * receives NULL on success and an owned DelotetError on failure: message and all elements at fault. Results are written on
 * success only; handles in out-parameters are NULL on failure.
 *
 * Arrays: input arrays are read during the call and copied; (NULL, 0) is the empty array. Output arrays are views: a pointer into
 * the object and a count, valid until the object is freed, never copied. Rows are contiguous; "#points by 3" means 3 numbers per
 * point. Indices are 0-based uint32_t; DELOTET_INVALID_INDEX means none. Views of records (DelotetSubfacesView, for instance) have a
 * stride, too: later versions may append fields to a record, so step from one to the next by `stride`, not by its size when you
 * compiled. DELOTET_AT does that:
 *
 *     DelotetSubfacesView faces = delotet_mesh_subfaces(mesh);
 *     for (size_t i = 0; i < faces.count; i++) {
 *         const DelotetSubface *face = DELOTET_AT(DelotetSubface, faces, i);
 *         ...
 *     }
 *
 * Threads: functions may be called from any thread. Functions that take const handles may run concurrently on the same handle;
 * functions that take non-const handles need exclusive use of it. Distinct handles share nothing. There is no global state that a
 * caller could see.
 *
 * Environment: the calling thread is in round-to-nearest mode. Nothing is printed, no signal handled, no locale read. Callbacks must
 * not throw C++ exceptions through the library (delotet.hpp takes care of that), not longjmp, and not use the handles of the call.
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
 * Record number `i` of a view of records: a `const Type *`. The compiler complains if `Type` is not what the view has. The view is
 * evaluated more than once.
 */
#define DELOTET_AT(Type, view, i)                                                                            \
    (1 ? (const Type *)(const void *)((const char *)(view).first + (size_t)(i) * (view).stride) : (view).first)

/**
 * Outcome of a call. Groups: 0 success; 1-9 the caller; 10-29 the input's geometry; 30-39 stopped or not possible within the
 * caller's limits; 40-49 resources; 50-59 files; 60-69 checks; 90 a bug of the library.
 */
typedef enum DelotetStatus {
    /**
     * Success.
     */
    DELOTET_STATUS_OK = 0,
    /**
     * An argument is NULL where that is not allowed, or outside its documented range.
     */
    DELOTET_STATUS_INVALID_ARGUMENT = 1,
    /**
     * Well-formed, but not offered: an unknown file format, a combination of options.
     */
    DELOTET_STATUS_UNSUPPORTED = 2,
    /**
     * A coordinate is NaN or infinite.
     */
    DELOTET_STATUS_NON_FINITE_POINT = 10,
    /**
     * The coordinates span more binary orders of magnitude than exact arithmetic in doubles can carry.
     */
    DELOTET_STATUS_COORDINATE_RANGE = 11,
    /**
     * An element refers to a point that does not exist.
     */
    DELOTET_STATUS_INDEX_OUT_OF_RANGE = 12,
    /**
     * A facet or segment has no extent, or a polygon is not usable as one.
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
     * A region seed lies outside the domain, or a region or hole seed on a facet.
     */
    DELOTET_STATUS_SEED_OUTSIDE = 18,
    /**
     * The surface encloses nothing, and the convex hull was not asked for.
     */
    DELOTET_STATUS_NOTHING_ENCLOSED = 19,
    /**
     * The caller's callback asked to stop.
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
     * A file's content is not what its format prescribes.
     */
    DELOTET_STATUS_FORMAT = 51,
    /**
     * A mesh does not pass its check.
     */
    DELOTET_STATUS_CHECK_FAILED = 60,
    /**
     * A failed invariant: a bug of the library, please report it. A handle that the call was changing may only be freed.
     */
    DELOTET_STATUS_INTERNAL = 90,
} DelotetStatus;

/**
 * Stages of a run. The numbers are fixed; they come in this order, but DELOTET_PHASE_PRESERVE before DELOTET_PHASE_AUDIT.
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
     * A coordinate cannot be brought into the exact range.
     */
    DELOTET_DEFECT_KIND_COORDINATE_RANGE = 2,
    /**
     * An index refers to nothing.
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
     * A polygon cannot be triangulated: it is folded in its own plane of projection.
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
     * An edge of one facet only, where a surface that encloses nothing leaks. The elements are its ends, the point its middle.
     */
    DELOTET_DEFECT_KIND_OPEN_EDGE = 16,
    /**
     * Two elements are too close to each other: no double fits where a Steiner point is needed at the first one, and the other is the nearest.
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
     * An edge of one facet only, on a part of the surface that encloses nothing: there it leaks. The elements are the ends.
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
     * A point is a corner of no tetrahedron, and equals no other point.
     */
    DELOTET_WARNING_KIND_UNMESHED_POINT = 4,
    /**
     * A point equals an earlier one, which is used instead. The elements are the point and the earlier one.
     */
    DELOTET_WARNING_KIND_EQUAL_POINTS = 5,
    /**
     * A region seed lies in a region that has an earlier seed, whose attribute is used. The elements are both seeds.
     */
    DELOTET_WARNING_KIND_REPEATED_SEED = 6,
    /**
     * A hole seed lies outside the domain: it has no effect.
     */
    DELOTET_WARNING_KIND_HOLE_OUTSIDE = 7,
    /**
     * A region has a volume bound, which is kept, but makes no tetrahedron smaller: there is no refinement yet.
     */
    DELOTET_WARNING_KIND_UNUSED_VOLUME = 8,
    /**
     * A polygon is not planar by more than rounding; it was triangulated.
     */
    DELOTET_WARNING_KIND_NON_PLANAR_FACET = 9,
    /**
     * A file's format cannot hold a value as it is.
     */
    DELOTET_WARNING_KIND_LOST_VALUE = 10,
} DelotetWarningKind;

/**
 * A failure: its status, a message for people, and all elements at fault. Made by the failing call, owned by the caller.
 */
typedef struct DelotetError DelotetError;

/**
 * A tetrahedral mesh: immutable, so any number of threads may read it.
 */
typedef struct DelotetMesh DelotetMesh;

/**
 * Settings of a run. One object may serve any number of runs, also at the same time (the callbacks are then called from all
 * their threads).
 */
typedef struct DelotetOptions DelotetOptions;

/**
 * A piecewise linear complex: points, segments, facets, hole seeds and region seeds. Indices of points, segments and facets
 * are 0-based, in the order of addition.
 */
typedef struct DelotetPlc DelotetPlc;

/**
 * How a mesh or a PLC is written. One object may serve any number of calls, also at the same time (the log is then called from all their
 * threads).
 */
typedef struct DelotetWriteOptions DelotetWriteOptions;

/**
 * One defect: kind, the one or two elements involved, and a point where it is seen.
 */
typedef struct DelotetDefect {
    /**
     * The kind: a DelotetDefectKind, in 32 bits with any compiler.
     */
    uint32_t kind;
    /**
     * What `first` counts: a DelotetElement.
     */
    uint32_t first_element;
    /**
     * Index of the element at fault.
     */
    uint32_t first;
    /**
     * What `second` counts: a DelotetElement, DELOTET_ELEMENT_NONE if only one element is involved.
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
     * How many.
     */
    size_t count;
    /**
     * Bytes from one to the next.
     */
    size_t stride;
} DelotetDefectsView;

/**
 * What is made of the input: one of the DELOTET_MODE_ constants.
 */
typedef uint32_t DelotetMode;

/**
 * What DELOTET_MODE_PRESERVE keeps: one of the DELOTET_PRESERVE_ constants.
 */
typedef uint32_t DelotetPreserve;

/**
 * Receives progress: `fraction` of `phase` is done, from 0 to 1. Phases come in their order, each once and up to 1 (those that are not
 * needed never), and fractions never fall: what is done again in another attempt shows as no progress. delotet_phase_overall() makes
 * one number of both. Return 0 to go on, anything else to cancel: the call then fails with DELOTET_STATUS_CANCELLED. Called on the
 * thread that made the call. Must not throw, must not longjmp, must not use the handles of the call.
 */
typedef int32_t (*DelotetProgressFn)(void *user_data, enum DelotetPhase phase, double fraction);

/**
 * Receives a line of text about the run: "warning: ..." and one line per kind of warning at its end; `message` is UTF-8 and valid during the call of the callback only. Called on the
 * thread that made the call. Must not throw, must not longjmp, must not use the handles of the call.
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
     * How many points.
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
     * How many rows.
     */
    size_t count;
    /**
     * How many doubles per row.
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
     * How many.
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
     * How many.
     */
    size_t count;
    /**
     * Bytes from one to the next.
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
     * The attribute that the tetrahedra there get.
     */
    double attribute;
    /**
     * The largest volume of a tetrahedron there; 0 if there is no bound.
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
     * How many.
     */
    size_t count;
    /**
     * Bytes from one to the next.
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
     * How many rows.
     */
    size_t count;
    /**
     * How many indices per row.
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
     * How many.
     */
    size_t count;
} DelotetIndicesView;

/**
 * How the rings of a facet bound it: one of the DELOTET_FACET_RULE_ constants.
 */
typedef uint32_t DelotetFacetRule;

/**
 * Borrowed quadruples of indices, one per tetrahedron; NULL and 0 if there are none.
 */
typedef struct DelotetTetsView {
    /**
     * #tetrahedra by 4 indices.
     */
    const uint32_t *data;
    /**
     * How many tetrahedra.
     */
    size_t count;
} DelotetTetsView;

/**
 * A region of the mesh: tetrahedra that are connected through unconstrained faces and share a seed (or have none).
 */
typedef struct DelotetRegion {
    /**
     * The attribute of the seed; for unseeded regions a number of its own, not used by any seed.
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
     * How many.
     */
    size_t count;
    /**
     * Bytes from one to the next.
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
     * The input facet it lies on (where coplanar neighbours with equal markers are meshed as one: one of them).
     */
    uint32_t facet;
    /**
     * That facet's marker.
     */
    int32_t marker;
    /**
     * The tetrahedra on both sides. The first is that of the lower region (by its index), within one region that of the lower index;
     * the second is DELOTET_INVALID_INDEX on the boundary. `(b - a) x (c - a)` points from the first to the second: from the
     * lower region to the higher, and outward on the boundary.
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
     * How many.
     */
    size_t count;
    /**
     * Bytes from one to the next.
     */
    size_t stride;
} DelotetSubfacesView;

/**
 * A piece of a segment or of a facet's edge: an edge of the mesh.
 */
typedef struct DelotetSubsegment {
    /**
     * The ends.
     */
    uint32_t ends[2];
    /**
     * The input segment it lies on, or DELOTET_INVALID_INDEX for an edge of facets.
     */
    uint32_t segment;
    /**
     * The segment's marker, 0 for an edge of facets.
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
     * How many.
     */
    size_t count;
    /**
     * Bytes from one to the next.
     */
    size_t stride;
} DelotetSubsegmentsView;

/**
 * A Steiner point and where it lies: on an edge of the input, or inside (DELOTET_MODE_PRESERVE), exactly where its doubles are.
 */
typedef struct DelotetSteinerPoint {
    /**
     * Input points a and b: the ends of the input edge that the point was put on, at exactly a + t (b - a); both
     * DELOTET_INVALID_INDEX for a point inside.
     */
    uint32_t ends[2];
    /**
     * The parameter t; 0 for a point inside. Terms beyond a double, which hardly any point has, are in delotet_mesh_steiner_terms.
     */
    double t;
    /**
     * The input segment it lies on, or DELOTET_INVALID_INDEX if the edge belongs to facets only or the point lies inside.
     */
    uint32_t segment;
    /**
     * Its coordinates are exactly a + t (b - a); false: they are rounded, or were moved to keep every tetrahedron positive.
     * True for a point inside.
     */
    bool exact;
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
     * How many.
     */
    size_t count;
    /**
     * Bytes from one to the next.
     */
    size_t stride;
} DelotetSteinerView;

/**
 * A term of a Steiner point's parameter beyond `t`: the exact parameter is the sum of `t` and its terms.
 */
typedef struct DelotetSteinerTerm {
    /**
     * Index into the Steiner points.
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
     * How many.
     */
    size_t count;
    /**
     * Bytes from one to the next.
     */
    size_t stride;
} DelotetSteinerTermsView;

/**
 * A flip of two facets' triangles that facet merging made before meshing.
 */
typedef struct DelotetFacetFlip {
    /**
     * The removed edge (input points).
     */
    uint32_t old_ends[2];
    /**
     * The edge in its place.
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
     * How many.
     */
    size_t count;
    /**
     * Bytes from one to the next.
     */
    size_t stride;
} DelotetFacetFlipsView;

/**
 * Counts and costs of the run that made a mesh. Later versions append fields: `struct_size` tells both sides how many there are.
 */
typedef struct DelotetStats {
    /**
     * Set by the caller to sizeof(DelotetStats); set by the library to the number of bytes that it wrote.
     */
    size_t struct_size;
    /**
     * Steiner points on segments and edges of facets.
     */
    uint64_t steiner;
    /**
     * Those whose double coordinates are exact.
     */
    uint64_t steiner_exact;
    /**
     * Those whose nearest double was not valid and that were moved to another position.
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
     * Largest number of bytes that the kernel's arrays held.
     */
    uint64_t peak_bytes;
    /**
     * Seconds per phase, indexed by DelotetPhase; unused entries are 0.
     */
    double seconds[16];
    /**
     * DELOTET_MODE_PRESERVE, else 0: edges of the surface missing from the Delaunay tetrahedralization of the points.
     */
    uint64_t preserve_missing_edges;
    /**
     * Triangles of the surface missing from it.
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
     * Edges and faces recovered by points on them, which were taken away again.
     */
    uint64_t preserve_by_splits;
    /**
     * Points on the surface taken away without a replacement.
     */
    uint64_t preserve_deleted;
    /**
     * Points on the surface taken away with points inside in their place.
     */
    uint64_t preserve_relocated;
    /**
     * Points added inside that are left.
     */
    uint64_t preserve_interior;
    /**
     * Points left on internal facets and segments (DELOTET_PRESERVE_OUTER).
     */
    uint64_t preserve_on_internal_facets;
    /**
     * Tetrahedra that took the place of ones that no doubles made positive (delotet_mesh_replaced_tets).
     */
    uint64_t replaced;
    /**
     * Largest resident memory of the process up to the end of the run in bytes, with all that the host holds; 0 where the system
     * does not tell.
     */
    uint64_t peak_resident_bytes;
} DelotetStats;

/**
 * One warning: kind, the one or two elements involved, and a point where it is seen.
 */
typedef struct DelotetWarning {
    /**
     * The kind: a DelotetWarningKind, in 32 bits with any compiler.
     */
    uint32_t kind;
    /**
     * What `first` counts: a DelotetElement.
     */
    uint32_t first_element;
    /**
     * Index of the element that it is about.
     */
    uint32_t first;
    /**
     * What `second` counts: a DelotetElement; DELOTET_ELEMENT_NONE if only one element is involved.
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
     * x y z of a point at or near it (rounded); zeros if there is none.
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
     * How many.
     */
    size_t count;
    /**
     * Bytes from one to the next.
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
     * The tetrahedra on both sides, the smaller index first, but of a subface in its order; the second is DELOTET_INVALID_INDEX on the
     * boundary.
     */
    uint32_t tets[2];
    /**
     * The subface that it is, or DELOTET_INVALID_INDEX.
     */
    uint32_t subface;
    /**
     * The subface's marker, else 0.
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
     * How many.
     */
    size_t count;
    /**
     * Bytes from one to the next.
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
     * A tetrahedron that has it.
     */
    uint32_t tet;
    /**
     * The subsegment that it is, or DELOTET_INVALID_INDEX.
     */
    uint32_t subsegment;
    /**
     * The subsegment's marker, else 0.
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
     * How many.
     */
    size_t count;
    /**
     * Bytes from one to the next.
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
     * #nodes by 3 doubles: the mid-edge nodes, one per edge in the order of delotet_mesh_edges. Node i has the index
     * #points + i.
     */
    const double *nodes;
    /**
     * How many mid-edge nodes.
     */
    size_t node_count;
    /**
     * #tetrahedra by 10 indices: four corners, then six mid-edge nodes.
     */
    const uint32_t *tets;
    /**
     * How many tetrahedra.
     */
    size_t tet_count;
} DelotetSecondOrderView;

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
 * segments only. The default.
 */
#define DELOTET_MODE_CONSTRAINED 1

/**
 * A tetrahedralization that keeps the surface as it is: every triangle is a face, every segment and every edge of a polygon is an
 * edge, without any point added on them; a polygon may get any diagonals. Points are added inside only, as few as possible.
 */
#define DELOTET_MODE_PRESERVE 2

/**
 * Every facet and segment. The default.
 */
#define DELOTET_PRESERVE_ALL 0

/**
 * The outer boundary: facets with the mesh on one side, and segments on these. Others (interfaces of regions, dangling facets) are
 * unions of faces and edges, with Steiner points on their segments where they would cost points inside.
 */
#define DELOTET_PRESERVE_OUTER 1

/**
 * The first ring is the outer boundary, the others are holes in it (delotet_plc_add_facet; all facets of one ring).
 */
#define DELOTET_FACET_RULE_RINGS 0

/**
 * TetGen's rule: holes are where hole seeds are (delotet_plc_add_facet_with_hole_seeds).
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
 * 4.1, of Gmsh 4. The default.
 */
#define DELOTET_MSH_4_1 41

/**
 * 2.2, which many solvers read and some of them only.
 */
#define DELOTET_MSH_2_2 22

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * Version of the loaded library: 1,000,000 * major + 1,000 * minor + patch, as DELOTET_VERSION is for the header.
 * Before 1.0 library and header must agree in major and minor. Any thread, any time; cannot fail.
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
 * The part of a whole run that is done when `fraction` of `phase` is, from 0 to 1: for a single bar of progress. It never falls during
 * a run, as phases come in their order. The shares of the phases are rough. 0 for other numbers.
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
 * The status of `error`, the same that the failing call returned; DELOTET_STATUS_OK for NULL.
 */
DELOTET_API enum DelotetStatus delotet_error_status(const struct DelotetError *error);

/**
 * One line in English, UTF-8. Borrowed from `error`: valid until it is freed. "" for NULL; never NULL.
 */
DELOTET_API const char *delotet_error_message(const struct DelotetError *error);

/**
 * All defects that the report lists (at most what delotet_options_set_max_defects allows). Borrowed from `error`: valid until
 * it is freed. Empty for NULL.
 */
DELOTET_API
struct DelotetDefectsView delotet_error_defects(const struct DelotetError *error);

/**
 * How many defects were found in all; the report may list fewer. 0 for NULL.
 */
DELOTET_API size_t delotet_error_defect_count(const struct DelotetError *error);

/**
 * Frees an error and all that was borrowed from it. NULL is ignored.
 */
DELOTET_API void delotet_error_free(struct DelotetError *error);

/**
 * New options with the defaults that the setters document. The caller owns them: free with delotet_options_free. NULL only if
 * memory ran out.
 */
DELOTET_API
DELOTET_MUST_USE
struct DelotetOptions *delotet_options_new(void);

/**
 * What is made: a DELOTET_MODE_ constant. Default: DELOTET_MODE_CONSTRAINED. Errors: INVALID_ARGUMENT (other values).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_mode(struct DelotetOptions *options,
                                            DelotetMode mode,
                                            struct DelotetError **out_error);

/**
 * What DELOTET_MODE_PRESERVE keeps: a DELOTET_PRESERVE_ constant; other modes do not ask. Default: DELOTET_PRESERVE_ALL.
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
 * Take facets with equal markers that meet above `angle` degrees (90 to 180) as one smooth patch, and flip its triangles to be
 * Delaunay on the surface first; delotet_mesh_facet_flips reports the flips. 0: off, the default. Errors: INVALID_ARGUMENT.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_merge_facets(struct DelotetOptions *options,
                                                    double angle,
                                                    struct DelotetError **out_error);

/**
 * Look for self-intersections and all other defects before meshing. Default: true. Without it an invalid PLC may end in
 * DELOTET_STATUS_INTERNAL. Errors: INVALID_ARGUMENT (NULL).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_validate(struct DelotetOptions *options,
                                                bool validate,
                                                struct DelotetError **out_error);

/**
 * How many defects an error lists at most, and how many warnings of a kind a mesh. Default: 1000. Errors: INVALID_ARGUMENT (NULL).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_max_defects(struct DelotetOptions *options,
                                                   size_t max_defects,
                                                   struct DelotetError **out_error);

/**
 * Worker threads; 0: as many as there are processors for this process. The mesh does not depend on it, bit for bit. Default: 1.
 * Errors: INVALID_ARGUMENT (NULL).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_threads(struct DelotetOptions *options,
                                               size_t threads,
                                               struct DelotetError **out_error);

/**
 * Give up with DELOTET_STATUS_STEINER_LIMIT beyond this many Steiner points. UINT64_MAX: the default, 100,000 and 100 more
 * per segment.
 * Errors: INVALID_ARGUMENT (NULL).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_steiner_limit(struct DelotetOptions *options,
                                                     uint64_t limit,
                                                     struct DelotetError **out_error);

/**
 * Return the mesh also if some Steiner points have no valid position in doubles, instead of DELOTET_STATUS_ROUNDING:
 * delotet_mesh_crowded_points() lists them, tetrahedra at them may be flat or inverted in doubles, and the exact mesh is
 * given by delotet_mesh_steiner_points(). Default: false. Errors: INVALID_ARGUMENT (NULL).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_exact_form(struct DelotetOptions *options,
                                                  bool exact_form,
                                                  struct DelotetError **out_error);

/**
 * Leave out the points that no tetrahedron has: those that equal an earlier one, and those around which all was carved. Input points
 * then have other numbers in the mesh, which delotet_mesh_point_map() tells. What is not meshed is not listed, as its points are gone;
 * it is still warned of. Default: false. Errors: INVALID_ARGUMENT (NULL).
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
 * Progress goes to `callback` together with `user_data`, which is only handed through. NULL: nowhere, the default.
 * Errors: INVALID_ARGUMENT (options is NULL).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_progress(struct DelotetOptions *options,
                                                DelotetProgressFn callback,
                                                void *user_data,
                                                struct DelotetError **out_error);

/**
 * Log lines go to `callback` together with `user_data`, which is only handed through. NULL: nowhere, the default; the library
 * itself never prints. Errors: INVALID_ARGUMENT (options is NULL).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_options_set_log(struct DelotetOptions *options,
                                           DelotetLogFn callback,
                                           void *user_data,
                                           struct DelotetError **out_error);

/**
 * The mode, as delotet_options_set_mode() sets it. For NULL, here and in all getters of options: the default.
 */
DELOTET_API DelotetMode delotet_options_mode(const struct DelotetOptions *options);

/**
 * What DELOTET_MODE_PRESERVE keeps, as delotet_options_set_preserve() sets it.
 */
DELOTET_API DelotetPreserve delotet_options_preserve(const struct DelotetOptions *options);

/**
 * Whether the convex hull is kept, as delotet_options_set_keep_hull() sets it.
 */
DELOTET_API bool delotet_options_keep_hull(const struct DelotetOptions *options);

/**
 * The angle of facet merging in degrees, 0 if it is off, as delotet_options_set_merge_facets() sets it.
 */
DELOTET_API double delotet_options_merge_facets(const struct DelotetOptions *options);

/**
 * Whether the input is validated, as delotet_options_set_validate() sets it.
 */
DELOTET_API bool delotet_options_validate(const struct DelotetOptions *options);

/**
 * How many defects an error lists at most, as delotet_options_set_max_defects() sets it.
 */
DELOTET_API size_t delotet_options_max_defects(const struct DelotetOptions *options);

/**
 * The number of worker threads, as delotet_options_set_threads() sets it.
 */
DELOTET_API size_t delotet_options_threads(const struct DelotetOptions *options);

/**
 * The limit on Steiner points, UINT64_MAX for the default one, as delotet_options_set_steiner_limit() sets it.
 */
DELOTET_API
uint64_t delotet_options_steiner_limit(const struct DelotetOptions *options);

/**
 * Whether a mesh is returned that has no valid doubles, as delotet_options_set_exact_form() sets it.
 */
DELOTET_API bool delotet_options_exact_form(const struct DelotetOptions *options);

/**
 * Whether points are left out that no tetrahedron has, as delotet_options_set_drop_unmeshed_points() sets it.
 */
DELOTET_API bool delotet_options_drop_unmeshed_points(const struct DelotetOptions *options);

/**
 * Whether sorting is skipped, as delotet_options_set_points_sorted() sets it.
 */
DELOTET_API bool delotet_options_points_sorted(const struct DelotetOptions *options);

/**
 * The progress callback, NULL if there is none, as delotet_options_set_progress() sets it.
 * `out_user_data`: NULL, or receives the pointer that was set with it (NULL without a callback).
 */
DELOTET_API
DelotetProgressFn delotet_options_progress(const struct DelotetOptions *options,
                                           void **out_user_data);

/**
 * The log callback, NULL if there is none, as delotet_options_set_log() sets it.
 * `out_user_data`: NULL, or receives the pointer that was set with it (NULL without a callback).
 */
DELOTET_API DelotetLogFn delotet_options_log(const struct DelotetOptions *options, void **out_user_data);

/**
 * Frees options. NULL is ignored. Not while a run uses them.
 */
DELOTET_API void delotet_options_free(struct DelotetOptions *options);

/**
 * A new PLC with these points and nothing else.
 * `xyz`: #points by 3 doubles, x y z per point; copied; may be NULL if `point_count` is 0. Finiteness is checked later, by
 * delotet_plc_check and delotet_tetrahedralize.
 * `out_plc`: the PLC, owned by the caller: free with delotet_plc_free; NULL on failure.
 * `out_error`: may be NULL; NULL on success, else an error to be freed with delotet_error_free. So for all functions here.
 * Errors: INVALID_ARGUMENT, TOO_LARGE (2^32 - 1 points or more), OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_new(const double *xyz,
                                   size_t point_count,
                                   struct DelotetPlc **out_plc,
                                   struct DelotetError **out_error);

/**
 * A copy of a PLC with all that it has.
 * `out_plc`: the copy, owned by the caller: free with delotet_plc_free; NULL on failure. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_clone(const struct DelotetPlc *plc,
                                     struct DelotetPlc **out_plc,
                                     struct DelotetError **out_error);

/**
 * Adds points after those that the PLC has. Their attributes and markers are 0, where the points have any.
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
 * Sets the attributes of all points (replacing earlier ones): fields that are carried to the mesh, linear at Steiner points.
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
 * Sets the markers of all points (replacing earlier ones).
 * `markers`: #points integers; copied; NULL removes them. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_set_point_markers(struct DelotetPlc *plc,
                                                 const int32_t *markers,
                                                 struct DelotetError **out_error);

/**
 * Sets the markers of all segments (replacing earlier ones).
 * `markers`: #segments integers; copied; NULL sets all to 0. Errors: INVALID_ARGUMENT.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_set_segment_markers(struct DelotetPlc *plc,
                                                   const int32_t *markers,
                                                   struct DelotetError **out_error);

/**
 * Sets the markers of all facets (replacing earlier ones).
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
 * Names a facet marker: files call groups by such names. `name`: UTF-8, zero-terminated; its first line is copied; NULL or "" takes
 * the name away. Errors: INVALID_ARGUMENT (also if `name` is not UTF-8), OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_set_marker_name(struct DelotetPlc *plc,
                                               int32_t marker,
                                               const char *name,
                                               struct DelotetError **out_error);

/**
 * Adds a segment from point `a` to point `b`. Edges of facets need not be given, unless they carry a marker.
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
 * `corners`: #triangles by 3 point indices; copied. `markers`: #triangles integers, or NULL (all 0). The order of the corners
 * is free. Coplanar neighbours with equal markers are meshed as one: the edge between them need not be an edge of the mesh, unless
 * it is a segment, too.
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
 * Adds one planar facet with holes: the first ring is its outer boundary, all others (three corners or more) are holes in it.
 * Rings of one or two corners are points and edges inside the facet that the mesh has to respect.
 * `corners`: the corner indices of all rings, one after the other; `ring_ends`: #rings ascending positions, as for
 * delotet_plc_add_polygons. Copied.
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
 * Adds one planar facet by TetGen's rule: what cannot be reached from outside without crossing an edge of a polygon belongs to
 * the facet, except what can be reached from a hole seed. Inner polygons and polygons of two corners constrain only.
 * `corners`, `polygon_ends`: as for delotet_plc_add_facet. `hole_seeds`: #holes by 3 doubles, one point in each hole; copied;
 * may be NULL if `hole_count` is 0.
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
 * Adds a hole: what can be reached from the point `seed` (x y z) without crossing a facet is not meshed.
 * Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. That the seed lies inside is checked later.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_add_hole(struct DelotetPlc *plc,
                                        const double *seed,
                                        struct DelotetError **out_error);

/**
 * Adds a region: the tetrahedra that can be reached from the point `seed` (x y z) without crossing a facet get `attribute`.
 * `max_volume`: largest volume of a tetrahedron there, carried to delotet_mesh_regions; not positive: none.
 * Errors: INVALID_ARGUMENT (also a NaN), OUT_OF_MEMORY. That the seed lies inside is checked later.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_add_region(struct DelotetPlc *plc,
                                          const double *seed,
                                          double attribute,
                                          double max_volume,
                                          struct DelotetError **out_error);

/**
 * Looks for defects: non-finite points, elements without extent, self-intersections, unusable polygons. All of them are listed
 * in the error, up to the maximum of `options`, which may be NULL (the defaults); progress is reported and may cancel. A surface that
 * encloses nothing fails too, with its open edges, unless `options` keep the hull or ask for DELOTET_MODE_DELAUNAY; where other parts
 * enclose something, the log gets a warning.
 * Errors: INVALID_ARGUMENT, the statuses from 10 to 29, CANCELLED, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_check(const struct DelotetPlc *plc,
                                     const struct DelotetOptions *options,
                                     struct DelotetError **out_error);

/**
 * Frees a PLC and all that was borrowed from it. NULL is ignored. Meshes made from it live on.
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
 * The markers of the points: one each, or none at all. Borrowed from `plc`: valid until it is changed or freed. Empty for NULL.
 */
DELOTET_API
struct DelotetMarkersView delotet_plc_point_markers(const struct DelotetPlc *plc);

/**
 * How many segments. 0 for NULL.
 */
DELOTET_API size_t delotet_plc_segment_count(const struct DelotetPlc *plc);

/**
 * How many facets: triangles and others. 0 for NULL.
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
 * The triangles that come first among the facets: #triangles by 3 indices, facets 0 to #triangles - 1. All facets, if only triangles
 * were added, or up to the first other facet; those behind have delotet_plc_facet_ring, which works for all. Borrowed from `plc`:
 * valid until it is changed or freed. Empty for NULL.
 */
DELOTET_API
struct DelotetIndexRowsView delotet_plc_triangles(const struct DelotetPlc *plc);

/**
 * How many rings (polygons) a facet has: 1 for triangles. 0 for NULL and for facets that do not exist.
 */
DELOTET_API size_t delotet_plc_facet_ring_count(const struct DelotetPlc *plc, uint32_t facet);

/**
 * The corners of a ring of a facet, in the order in which they were given. Borrowed from `plc`: valid until it is changed or freed.
 * Empty for NULL and for rings that do not exist.
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
 * How many facet markers have names: those of the groups, solids, materials or colours of a file, and those set by
 * delotet_plc_set_marker_name. 0 for NULL.
 */
DELOTET_API
size_t delotet_plc_marker_name_count(const struct DelotetPlc *plc);

/**
 * The name of a facet marker, UTF-8, zero-terminated; NULL if it has none, and for NULL. Borrowed from `plc`: valid until it is
 * changed or freed.
 */
DELOTET_API
const char *delotet_plc_marker_name(const struct DelotetPlc *plc,
                                    int32_t marker);

/**
 * The markers that have names, ascending: number `index` of them. 0 for NULL and for indices of delotet_plc_marker_name_count and
 * above.
 */
DELOTET_API
int32_t delotet_plc_named_marker(const struct DelotetPlc *plc,
                                 size_t index);

/**
 * All points: the input points first, bit for bit and in input order, then the Steiner points. Borrowed from `mesh`: valid until
 * it is freed, as all views of a mesh are. Empty for NULL.
 */
DELOTET_API
struct DelotetPointsView delotet_mesh_points(const struct DelotetMesh *mesh);

/**
 * How many of the points are input points. 0 for NULL.
 */
DELOTET_API size_t delotet_mesh_input_point_count(const struct DelotetMesh *mesh);

/**
 * For each input point the first input point equal to it (itself, if there is none): tetrahedra use only that one. Borrowed
 * from `mesh`. Empty for NULL.
 */
DELOTET_API
struct DelotetIndicesView delotet_mesh_point_aliases(const struct DelotetMesh *mesh);

/**
 * Where input points are in a mesh made with delotet_options_set_drop_unmeshed_points(): per input point its index in
 * delotet_mesh_points(), of a point that equals an earlier one that one's; DELOTET_INVALID_INDEX if it was left out. Borrowed from `mesh`.
 * Empty for NULL and without that option: points then keep their numbers.
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
 * Tetrahedra that took the place of ones that no doubles made positive, ascending: almost flat facets force them. They are positive, but
 * not necessarily Delaunay. Where sheets leave doubles no room for points on the surface, the mesh has none there, and these are all
 * tetrahedra at faces that are not locally Delaunay. Borrowed from `mesh`. Empty for NULL.
 */
DELOTET_API
struct DelotetIndicesView delotet_mesh_replaced_tets(const struct DelotetMesh *mesh);

/**
 * Attributes of all points: #points by `width`: the input's, and at Steiner points linear between the ends of the input edge, inside
 * in a tetrahedron of points around.
 * Borrowed from `mesh`. Empty for NULL and if the input had none.
 */
DELOTET_API
struct DelotetDoublesView delotet_mesh_point_attributes(const struct DelotetMesh *mesh);

/**
 * Markers of all points: the input's, at Steiner points their segment's, 0 on an edge of facets only and inside. Borrowed from `mesh`.
 * Empty for NULL and if the input had none.
 */
DELOTET_API
struct DelotetMarkersView delotet_mesh_point_markers(const struct DelotetMesh *mesh);

/**
 * The tetrahedra: four corners each, positive: det(b - a, c - a, d - a) > 0, as in VTK, Gmsh and TetGen's output. Borrowed from
 * `mesh`. Empty for NULL.
 */
DELOTET_API
struct DelotetTetsView delotet_mesh_tets(const struct DelotetMesh *mesh);

/**
 * Neighbours: per tetrahedron and corner i the tetrahedron beyond the face opposite that corner, or DELOTET_INVALID_INDEX.
 * Borrowed from `mesh`. Empty for NULL.
 */
DELOTET_API
struct DelotetTetsView delotet_mesh_neighbors(const struct DelotetMesh *mesh);

/**
 * Per tetrahedron the index of its region in delotet_mesh_regions. Borrowed from `mesh`. Empty for NULL.
 */
DELOTET_API struct DelotetIndicesView delotet_mesh_tet_regions(const struct DelotetMesh *mesh);

/**
 * The regions. Borrowed from `mesh`. Empty for NULL.
 */
DELOTET_API struct DelotetRegionsView delotet_mesh_regions(const struct DelotetMesh *mesh);

/**
 * The faces on facets, with facet, marker and both tetrahedra; pieces of facets that bound no tetrahedron are in
 * delotet_mesh_unmeshed_subfaces. Borrowed from `mesh`. Empty for NULL.
 */
DELOTET_API
struct DelotetSubfacesView delotet_mesh_subfaces(const struct DelotetMesh *mesh);

/**
 * The edges on segments and on edges of facets, with segment and marker. Borrowed from `mesh`. Empty for NULL.
 */
DELOTET_API
struct DelotetSubsegmentsView delotet_mesh_subsegments(const struct DelotetMesh *mesh);

/**
 * Pieces of facets that bound no tetrahedron, since all around them was carved: a shell that leaks, a facet outside of the domain, a
 * wall in a hole. They are no faces of the mesh: both tetrahedra are DELOTET_INVALID_INDEX. Borrowed from `mesh`. Empty for NULL.
 */
DELOTET_API
struct DelotetSubfacesView delotet_mesh_unmeshed_subfaces(const struct DelotetMesh *mesh);

/**
 * Pieces of segments and of edges of facets that are edges of no tetrahedron. Borrowed from `mesh`. Empty for NULL.
 */
DELOTET_API
struct DelotetSubsegmentsView delotet_mesh_unmeshed_subsegments(const struct DelotetMesh *mesh);

/**
 * Points that no tetrahedron has, ascending: those that equal an earlier point (delotet_mesh_point_aliases), and those around which
 * all was carved. Borrowed from `mesh`. Empty for NULL.
 */
DELOTET_API
struct DelotetIndicesView delotet_mesh_unmeshed_points(const struct DelotetMesh *mesh);

/**
 * The Steiner points in the order of the points, with the input edge and the segment they lie on, if any. Borrowed from `mesh`. Empty
 * for NULL.
 */
DELOTET_API
struct DelotetSteinerView delotet_mesh_steiner_points(const struct DelotetMesh *mesh);

/**
 * Terms of parameters that need more than a double (segments an ulp or so apart), in the order of the Steiner points, the
 * largest term of a point first. Borrowed from `mesh`. Empty for NULL.
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
 * Errors: INVALID_ARGUMENT (NULL, or a struct_size too small for itself).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_stats(const struct DelotetMesh *mesh,
                                      struct DelotetStats *stats,
                                      struct DelotetError **out_error);

/**
 * Checks a mesh against its PLC, exactly: all tetrahedra positive and conforming, points unmoved, segments and facets covered;
 * with `constrained_delaunay` also that every unconstrained face is locally Delaunay. A facet that the mesh has no subfaces of is a
 * defect, unless the mesh was made in mode DELOTET_MODE_DELAUNAY, which promises no facets and segments: these are not asked for
 * then. The error lists at most `max_defects`.
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
 * Checks a mesh like delotet_mesh_check(), without the Delaunay property, and that it keeps the surface as DELOTET_MODE_PRESERVE
 * promises: every input triangle is a face (or, if input points lie on it, a union of faces between these), every polygon a union of
 * faces and every segment one of edges between input points, and no added point lies on a facet or segment. That is asked of any mesh, whatever its mode. The error lists at most `max_defects`. Errors: INVALID_ARGUMENT, CHECK_FAILED, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_check_preserved(const struct DelotetMesh *mesh,
                                                const struct DelotetPlc *plc,
                                                size_t max_defects,
                                                struct DelotetError **out_error);

/**
 * Checks a mesh like delotet_mesh_check_preserved(), but of the outer boundary only, as DELOTET_PRESERVE_OUTER promises: other facets
 * and segments must be covered, and may have added points. The error lists at most `max_defects`.
 * Errors: INVALID_ARGUMENT, CHECK_FAILED, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_check_preserved_outer(const struct DelotetMesh *mesh,
                                                      const struct DelotetPlc *plc,
                                                      size_t max_defects,
                                                      struct DelotetError **out_error);

/**
 * Frees a mesh and all that was borrowed from it. NULL is ignored.
 */
DELOTET_API void delotet_mesh_free(struct DelotetMesh *mesh);

/**
 * What should be known about a mesh: leaks, parts of the input that are not meshed, seeds without effect. Of each kind at most as many
 * as delotet_options_set_max_defects allows; delotet_mesh_warning_count() counts all. The log gets a line per kind. Borrowed from
 * `mesh`. Empty for NULL.
 */
DELOTET_API
struct DelotetWarningsView delotet_mesh_warnings(const struct DelotetMesh *mesh);

/**
 * How many warnings of a kind (a DelotetWarningKind) there are, listed or not. 0 for NULL and for other numbers.
 */
DELOTET_API
uint64_t delotet_mesh_warning_count(const struct DelotetMesh *mesh,
                                    uint32_t kind);

/**
 * Makes the mesh of a PLC.
 * `options`: NULL for the defaults. `out_mesh`: the mesh, owned by the caller: free with delotet_mesh_free; NULL on failure. It
 * does not refer to `plc` or `options`. `out_error`: may be NULL; NULL on success, else an error to be freed with
 * delotet_error_free: it lists the elements at fault.
 * The same input and options give the same mesh, bit for bit. The stack of the calling thread may be small (256 KiB do).
 * Errors: INVALID_ARGUMENT, the statuses from 10 to 41, INTERNAL.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_tetrahedralize(const struct DelotetPlc *plc,
                                          const struct DelotetOptions *options,
                                          struct DelotetMesh **out_mesh,
                                          struct DelotetError **out_error);

/**
 * The region attribute of each tetrahedron: #tetrahedra by 1. Made on first use; borrowed from `mesh`, valid until it is freed.
 * Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_tet_attributes(const struct DelotetMesh *mesh,
                                               struct DelotetDoublesView *out_view,
                                               struct DelotetError **out_error);

/**
 * For each point a tetrahedron that has it as a corner (the first), or DELOTET_INVALID_INDEX if none has. Made on first use;
 * borrowed from `mesh`. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_point_tets(const struct DelotetMesh *mesh,
                                           struct DelotetIndicesView *out_view,
                                           struct DelotetError **out_error);

/**
 * All faces, each once; delotet_mesh_subfaces has the constrained ones only. Made on first use; borrowed from `mesh`.
 * Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_faces(const struct DelotetMesh *mesh,
                                      struct DelotetFacesView *out_view,
                                      struct DelotetError **out_error);

/**
 * Per tetrahedron its four faces (indices into delotet_mesh_faces), face i opposite corner i. Made on first use; borrowed from
 * `mesh`. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_tet_faces(const struct DelotetMesh *mesh,
                                          struct DelotetTetsView *out_view,
                                          struct DelotetError **out_error);

/**
 * All edges, each once, ascending by their ends; delotet_mesh_subsegments has the constrained ones only. Made on first use;
 * borrowed from `mesh`. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY, TOO_LARGE.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_edges(const struct DelotetMesh *mesh,
                                      struct DelotetEdgesView *out_view,
                                      struct DelotetError **out_error);

/**
 * Per tetrahedron its edges 01 02 03 12 13 23 (indices into delotet_mesh_edges): #tetrahedra by 6. Made on first use; borrowed
 * from `mesh`. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY, TOO_LARGE.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_tet_edges(const struct DelotetMesh *mesh,
                                          struct DelotetIndexRowsView *out_view,
                                          struct DelotetError **out_error);

/**
 * Per subface (a, b, c) its edges ab bc ca (indices into delotet_mesh_edges): #subfaces by 3. With second-order nodes the node
 * on edge i is #points + i. Made on first use; borrowed from `mesh`. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY, TOO_LARGE.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_subface_edges(const struct DelotetMesh *mesh,
                                              struct DelotetIndexRowsView *out_view,
                                              struct DelotetError **out_error);

/**
 * Second-order tetrahedra: a node in the middle of every edge (rounded to doubles), shared by all tetrahedra around it.
 * `node_order`: a DELOTET_NODE_ORDER_ constant. Made on first use; borrowed from `mesh`.
 * Errors: INVALID_ARGUMENT, OUT_OF_MEMORY, TOO_LARGE.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_second_order(const struct DelotetMesh *mesh,
                                             DelotetNodeOrder node_order,
                                             struct DelotetSecondOrderView *out_view,
                                             struct DelotetError **out_error);

/**
 * Finds the tetrahedra that hold points, exactly; a point on a common face, edge or corner belongs to the tetrahedron with the
 * smallest index.
 * `xyz`: #points by 3 doubles. `out_tets`: #points indices, written: DELOTET_INVALID_INDEX outside the mesh and for points that
 * are not finite. `out_barycentric`: NULL, or #points by 4 doubles, written: the barycentric coordinates in that tetrahedron,
 * none negative, with sum 1 up to rounding; NaN outside. A linear field at the point is the sum of coordinate times corner
 * value. The search tree is made on first use and kept: about 40 bytes per tetrahedron.
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
 * Reads a PLC from a file; the extension names the format (src/doc/formats.md lists them).
 * `path`: zero-terminated; any bytes on Unix, UTF-8 elsewhere. `out_plc`: owned by the caller: free with delotet_plc_free; NULL
 * on failure.
 * Errors: INVALID_ARGUMENT, UNSUPPORTED (an unknown format, or a library built without files), FILE, FORMAT, INDEX_OUT_OF_RANGE,
 * TOO_LARGE, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_read(const char *path,
                                    struct DelotetPlc **out_plc,
                                    struct DelotetError **out_error);

/**
 * Writes a PLC to a file; the extension names the format (src/doc/formats.md lists the surface formats). Nothing is told of values that
 * the format cannot hold: delotet_plc_write_with() does.
 * Errors: INVALID_ARGUMENT, UNSUPPORTED (an unknown format, one that cannot hold what the PLC has, or a library built without files),
 * NON_FINITE_POINT, FILE, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_plc_write(const struct DelotetPlc *plc,
                                     const char *path,
                                     struct DelotetError **out_error);

/**
 * Writes a mesh to a file; the extension names the format (src/doc/formats.md lists them). `plc` is the PLC that the mesh was made of: some
 * formats carry its markers and attributes. Nothing is told of values that the format cannot hold: delotet_mesh_write_with() does.
 * Errors: INVALID_ARGUMENT, UNSUPPORTED (an unknown format, or a library built without files), FILE, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_write(const struct DelotetMesh *mesh,
                                      const struct DelotetPlc *plc,
                                      const char *path,
                                      struct DelotetError **out_error);

/**
 * New options with the defaults that the setters document. The caller owns them: free with delotet_write_options_free. NULL only
 * if memory ran out.
 */
DELOTET_API
DELOTET_MUST_USE
struct DelotetWriteOptions *delotet_write_options_new(void);

/**
 * .vtu: compress the arrays (zlib); smaller and slower. Other formats ignore it. Default: false. Errors: INVALID_ARGUMENT (NULL).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_write_options_set_compress(struct DelotetWriteOptions *options,
                                                      bool compress,
                                                      struct DelotetError **out_error);

/**
 * .vtu: also write the subfaces, as STEM_subfaces.vtu for STEM.vtu. Other formats ignore it: they have them in any case, but for .vtk.
 * Default: false. Errors: INVALID_ARGUMENT (NULL).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_write_options_set_subfaces(struct DelotetWriteOptions *options,
                                                      bool subfaces,
                                                      struct DelotetError **out_error);

/**
 * Tetrahedra of ten nodes: the corners, then the middles of the edges in the order of the format. Writing .mesh fails with it.
 * Default: false. Errors: INVALID_ARGUMENT (NULL).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_write_options_set_second_order(struct DelotetWriteOptions *options,
                                                          bool second_order,
                                                          struct DelotetError **out_error);

/**
 * .msh: the version, a DELOTET_MSH_ constant. Other formats ignore it. Default: DELOTET_MSH_4_1. Errors: INVALID_ARGUMENT (other
 * values).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_write_options_set_msh_version(struct DelotetWriteOptions *options,
                                                         DelotetMshVersion version,
                                                         struct DelotetError **out_error);

/**
 * .msh, .inp: the name of the regions with an attribute; other formats ignore it. `name`: zero-terminated UTF-8, copied, of which
 * the first line counts; NULL or an empty one takes the name away. Default: no names.
 * Errors: INVALID_ARGUMENT (NULL, an attribute that is not finite, a name that is not UTF-8), OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_write_options_set_region_name(struct DelotetWriteOptions *options,
                                                         double attribute,
                                                         const char *name,
                                                         struct DelotetError **out_error);

/**
 * Lines of text about what is written go to `callback` together with `user_data`, which is only handed through: a line
 * "warning: ..." for each kind of thing that the format cannot hold or that has no effect in it. NULL: nowhere, the default.
 * Errors: INVALID_ARGUMENT (options is NULL).
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_write_options_set_log(struct DelotetWriteOptions *options,
                                                 DelotetLogFn callback,
                                                 void *user_data,
                                                 struct DelotetError **out_error);

/**
 * Whether arrays are compressed. For NULL, here and in all getters of options: the default.
 */
DELOTET_API bool delotet_write_options_compress(const struct DelotetWriteOptions *options);

/**
 * Whether subfaces are written too, as delotet_write_options_set_subfaces() sets it.
 */
DELOTET_API bool delotet_write_options_subfaces(const struct DelotetWriteOptions *options);

/**
 * Whether tetrahedra have ten nodes, as delotet_write_options_set_second_order() sets it.
 */
DELOTET_API bool delotet_write_options_second_order(const struct DelotetWriteOptions *options);

/**
 * The version of .msh, as delotet_write_options_set_msh_version() sets it.
 */
DELOTET_API DelotetMshVersion delotet_write_options_msh_version(const struct DelotetWriteOptions *options);

/**
 * The name of the regions with an attribute: UTF-8, NULL if they have none. Borrowed from `options` until it is changed.
 */
DELOTET_API
const char *delotet_write_options_region_name(const struct DelotetWriteOptions *options,
                                              double attribute);

/**
 * The log callback, NULL if there is none, as delotet_write_options_set_log() sets it.
 * `out_user_data`: NULL, or receives the pointer that was set with it (NULL without a callback).
 */
DELOTET_API
DelotetLogFn delotet_write_options_log(const struct DelotetWriteOptions *options,
                                       void **out_user_data);

/**
 * Frees options. NULL is ignored. Not while a call uses them.
 */
DELOTET_API void delotet_write_options_free(struct DelotetWriteOptions *options);

/**
 * Writes a mesh to a file as delotet_mesh_write() does, in the way that `options` ask for (NULL: the defaults). What the format
 * cannot hold as it is goes to the options' log; the guide's page on formats says what each one holds.
 * Errors: INVALID_ARGUMENT, UNSUPPORTED (an unknown format, one without second order, or a library built without files), FILE,
 * TOO_LARGE, OUT_OF_MEMORY.
 */
DELOTET_API
DELOTET_MUST_USE
enum DelotetStatus delotet_mesh_write_with(const struct DelotetMesh *mesh,
                                           const struct DelotetPlc *plc,
                                           const char *path,
                                           const struct DelotetWriteOptions *options,
                                           struct DelotetError **out_error);

/**
 * Writes a PLC to a file as delotet_plc_write() does, and tells the options' log what the format cannot hold as it is (NULL: nobody). No
 * other option has an effect on surface formats; the log is told of those that are set.
 * Errors: INVALID_ARGUMENT, UNSUPPORTED (an unknown format, one that cannot hold what the PLC has, or a library built without files),
 * NON_FINITE_POINT, FILE, OUT_OF_MEMORY.
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
