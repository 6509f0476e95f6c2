//! Status codes, kinds of defects and elements, phases: the enumerations that the library returns, with fixed numbers.
//! Numbers are never reused; retired ones stay here as comments.
use crate::error::{DefectKind, Element, Status};
use crate::progress::Phase;
use crate::warning::WarningKind;
use libc::c_char;

/// Outcome of a call. Groups: 0 success; 1-9 the caller; 10-29 the input's geometry; 30-39 cancelled, or impossible within the caller's
/// limits; 40-49 resources; 50-59 files; 60-69 checks; 90 a bug in the library.
// Retired, since nothing ever returned them: 13 (equal points where they are not allowed), 32 (Steiner points where they are forbidden).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DelotetStatus {
    /// Success.
    Ok = 0,
    /// An argument is NULL where that is not allowed, or is outside its documented range.
    InvalidArgument = 1,
    /// Well-formed, but not supported: an unknown file format, a combination of options.
    Unsupported = 2,
    /// A coordinate is NaN or infinite.
    NonFinitePoint = 10,
    /// The coordinates span more binary orders of magnitude than exact arithmetic in doubles can handle.
    CoordinateRange = 11,
    /// An element refers to a point that does not exist.
    IndexOutOfRange = 12,
    /// A facet or segment has no extent, or a ring is not a usable polygon.
    DegenerateFacet = 14,
    /// A polygon is too far from planar to be triangulated without crossing itself.
    NonPlanarFacet = 15,
    /// Elements of the PLC cross or overlap outside their common points and edges.
    SelfIntersection = 16,
    /// All points lie in one plane: there is no tetrahedron.
    DegenerateInput = 17,
    /// A region seed lies outside the domain, or a region or hole seed lies on a facet.
    SeedOutside = 18,
    /// The surface encloses nothing, and the convex hull was not requested.
    NothingEnclosed = 19,
    /// The caller asked to stop, by its callback or its token.
    Cancelled = 30,
    /// The caller's limit on Steiner points was reached.
    SteinerLimit = 31,
    /// The exact mesh exists, but some Steiner points have no valid position in doubles: elements are too close to each other.
    Rounding = 33,
    /// The caller's limit on time was reached.
    TimeLimit = 34,
    /// The caller's limit on memory was reached.
    MemoryLimit = 35,
    /// The caller's limit on tetrahedra was reached.
    TetrahedraLimit = 36,
    /// Memory ran out.
    OutOfMemory = 40,
    /// More elements than 32-bit indices can address.
    TooLarge = 41,
    /// A file cannot be opened, read or written.
    File = 50,
    /// The content of a file does not follow its format.
    Format = 51,
    /// A mesh failed its check.
    CheckFailed = 60,
    /// An invariant failed: a bug in the library, please report it. Any handle that the call was modifying may only be freed.
    Internal = 90,
}

/// What kind of element an index refers to.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DelotetElement {
    /// No element.
    None = 0,
    /// An input point (in a check of a mesh: a point of the mesh).
    Point = 1,
    /// An input segment, in the order of addition.
    Segment = 2,
    /// An input facet, in the order of addition.
    Facet = 3,
    /// A hole seed.
    Hole = 4,
    /// A region seed.
    Region = 5,
    /// A tetrahedron of the mesh.
    Tet = 6,
}

/// What kind of defect was found.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DelotetDefectKind {
    /// A coordinate is NaN or infinite.
    NonFinite = 1,
    /// A coordinate cannot be scaled into the exact range.
    CoordinateRange = 2,
    /// An index refers to no element.
    IndexOutOfRange = 3,
    /// A segment joins a point with itself or with an equal one.
    DegenerateSegment = 4,
    /// A facet has no area, fewer than three distinct corners, or a ring that is not a polygon.
    DegenerateFacet = 5,
    /// A ring of a facet touches or crosses itself or another ring of the facet.
    RingIntersection = 6,
    /// An inner ring lies outside the outer one, or inside another inner ring.
    RingNesting = 7,
    /// A polygon cannot be triangulated: its projection onto a plane folds over itself.
    NonPlanarFacet = 8,
    /// Two facets cover the same triangle.
    DuplicateFacet = 9,
    /// Two segments cross at an inner point of both.
    SegmentSegment = 10,
    /// A segment (or an edge of a facet) pierces a facet.
    SegmentFacet = 11,
    /// Two facets cross.
    FacetFacet = 12,
    /// Two coplanar facets, or a facet and a segment in it, overlap along an area or a line without sharing it.
    Overlap = 13,
    /// A seed lies exactly on a facet.
    SeedOnFacet = 14,
    /// A seed lies outside the domain.
    SeedOutside = 15,
    /// An edge of only one facet, where a surface that encloses nothing leaks. The elements are its ends, the point its midpoint.
    OpenEdge = 16,
    /// Two elements are too close to each other: a Steiner point needed on the first has no valid position in doubles, and the second is
    /// the element nearest to it.
    Rounding = 17,
    /// A tetrahedron is flat (zero volume) or inverted.
    NotPositive = 18,
    /// A face is shared by more than two tetrahedra, or by two on the same side, or a neighbour is wrong.
    NotConforming = 19,
    /// An input point is missing from the mesh or was moved.
    PointMoved = 20,
    /// A segment is not a union of edges of the mesh.
    SegmentMissing = 21,
    /// A facet is not a union of faces of the mesh.
    FacetMissing = 22,
    /// An unconstrained face is not locally Delaunay.
    NotDelaunay = 23,
    /// A boundary face of the mesh lies on no facet.
    HullOffFacets = 24,
}

/// What a warning is about.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DelotetWarningKind {
    /// An edge of only one facet, on a part of the surface that encloses nothing: it leaks there. The elements are the ends.
    OpenEdge = 1,
    /// A part of a facet bounds no tetrahedron.
    UnmeshedFacet = 2,
    /// A part of a segment is an edge of no tetrahedron.
    UnmeshedSegment = 3,
    /// A point is a corner of no tetrahedron and equals no earlier point.
    UnmeshedPoint = 4,
    /// A point equals an earlier one, which is used instead. The elements are the point and the earlier one.
    EqualPoints = 5,
    /// Two region seeds lie in one region; the attribute of the earlier is used. The elements are the later seed and the earlier one.
    RepeatedSeed = 6,
    /// A hole seed lies outside the domain and has no effect.
    HoleOutside = 7,
    /// A region has a volume bound, which has no effect unless the mesh is filled with points (delotet_options_set_size()).
    UnusedVolume = 8,
    /// A polygon is out of plane by more than rounding; it was triangulated.
    NonPlanarFacet = 9,
    /// A file's format cannot hold a value as it is.
    LostValue = 10,
}

/// Stages of a run. The numbers are fixed. The stages run in this order, except that DELOTET_PHASE_PRESERVE and DELOTET_PHASE_REFINE come
/// before DELOTET_PHASE_ROUND, and DELOTET_PHASE_OPTIMIZE before DELOTET_PHASE_AUDIT.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DelotetPhase {
    /// Reading a file.
    Read = 0,
    /// Checking the input.
    Validate = 1,
    /// Delaunay tetrahedralization of the points.
    Delaunay = 2,
    /// Segment recovery.
    Segments = 3,
    /// Facet recovery.
    Facets = 4,
    /// Carving, holes and regions.
    Regions = 5,
    /// Rounding Steiner points to doubles.
    Round = 6,
    /// The exact audit of the result.
    Audit = 7,
    /// Writing files.
    Write = 8,
    /// Keeping the surface as it is (DELOTET_MODE_PRESERVE).
    Preserve = 9,
    /// Points by size and shape (delotet_options_set_size(), delotet_options_set_quality()).
    Refine = 10,
    /// Optimisation (delotet_options_set_optimize()).
    Optimize = 11,
}

impl From<Status> for DelotetStatus {
    fn from(status: Status) -> Self {
        match status {
            Status::InvalidArgument => DelotetStatus::InvalidArgument,
            Status::Unsupported => DelotetStatus::Unsupported,
            Status::NonFinitePoint => DelotetStatus::NonFinitePoint,
            Status::CoordinateRange => DelotetStatus::CoordinateRange,
            Status::IndexOutOfRange => DelotetStatus::IndexOutOfRange,
            Status::DegenerateFacet => DelotetStatus::DegenerateFacet,
            Status::NonPlanarFacet => DelotetStatus::NonPlanarFacet,
            Status::SelfIntersection => DelotetStatus::SelfIntersection,
            Status::DegenerateInput => DelotetStatus::DegenerateInput,
            Status::SeedOutside => DelotetStatus::SeedOutside,
            Status::NothingEnclosed => DelotetStatus::NothingEnclosed,
            Status::Cancelled => DelotetStatus::Cancelled,
            Status::SteinerLimit => DelotetStatus::SteinerLimit,
            Status::Rounding => DelotetStatus::Rounding,
            Status::TimeLimit => DelotetStatus::TimeLimit,
            Status::MemoryLimit => DelotetStatus::MemoryLimit,
            Status::TetrahedraLimit => DelotetStatus::TetrahedraLimit,
            Status::OutOfMemory => DelotetStatus::OutOfMemory,
            Status::TooLarge => DelotetStatus::TooLarge,
            Status::File => DelotetStatus::File,
            Status::Format => DelotetStatus::Format,
            Status::CheckFailed => DelotetStatus::CheckFailed,
            Status::Internal => DelotetStatus::Internal,
        }
    }
}

impl From<DefectKind> for DelotetDefectKind {
    fn from(kind: DefectKind) -> Self {
        match kind {
            DefectKind::NonFinite => DelotetDefectKind::NonFinite,
            DefectKind::CoordinateRange => DelotetDefectKind::CoordinateRange,
            DefectKind::IndexOutOfRange => DelotetDefectKind::IndexOutOfRange,
            DefectKind::DegenerateSegment => DelotetDefectKind::DegenerateSegment,
            DefectKind::DegenerateFacet => DelotetDefectKind::DegenerateFacet,
            DefectKind::RingIntersection => DelotetDefectKind::RingIntersection,
            DefectKind::RingNesting => DelotetDefectKind::RingNesting,
            DefectKind::NonPlanarFacet => DelotetDefectKind::NonPlanarFacet,
            DefectKind::DuplicateFacet => DelotetDefectKind::DuplicateFacet,
            DefectKind::SegmentSegment => DelotetDefectKind::SegmentSegment,
            DefectKind::SegmentFacet => DelotetDefectKind::SegmentFacet,
            DefectKind::FacetFacet => DelotetDefectKind::FacetFacet,
            DefectKind::Overlap => DelotetDefectKind::Overlap,
            DefectKind::SeedOnFacet => DelotetDefectKind::SeedOnFacet,
            DefectKind::SeedOutside => DelotetDefectKind::SeedOutside,
            DefectKind::OpenEdge => DelotetDefectKind::OpenEdge,
            DefectKind::Rounding => DelotetDefectKind::Rounding,
            DefectKind::NotPositive => DelotetDefectKind::NotPositive,
            DefectKind::NotConforming => DelotetDefectKind::NotConforming,
            DefectKind::PointMoved => DelotetDefectKind::PointMoved,
            DefectKind::SegmentMissing => DelotetDefectKind::SegmentMissing,
            DefectKind::FacetMissing => DelotetDefectKind::FacetMissing,
            DefectKind::NotDelaunay => DelotetDefectKind::NotDelaunay,
            DefectKind::HullOffFacets => DelotetDefectKind::HullOffFacets,
        }
    }
}

impl From<WarningKind> for DelotetWarningKind {
    fn from(kind: WarningKind) -> Self {
        match kind {
            WarningKind::OpenEdge => DelotetWarningKind::OpenEdge,
            WarningKind::UnmeshedFacet => DelotetWarningKind::UnmeshedFacet,
            WarningKind::UnmeshedSegment => DelotetWarningKind::UnmeshedSegment,
            WarningKind::UnmeshedPoint => DelotetWarningKind::UnmeshedPoint,
            WarningKind::EqualPoints => DelotetWarningKind::EqualPoints,
            WarningKind::RepeatedSeed => DelotetWarningKind::RepeatedSeed,
            WarningKind::HoleOutside => DelotetWarningKind::HoleOutside,
            WarningKind::UnusedVolume => DelotetWarningKind::UnusedVolume,
            WarningKind::NonPlanarFacet => DelotetWarningKind::NonPlanarFacet,
            WarningKind::LostValue => DelotetWarningKind::LostValue,
        }
    }
}

impl From<Phase> for DelotetPhase {
    fn from(phase: Phase) -> Self {
        match phase {
            Phase::Read => DelotetPhase::Read,
            Phase::Validate => DelotetPhase::Validate,
            Phase::Delaunay => DelotetPhase::Delaunay,
            Phase::Segments => DelotetPhase::Segments,
            Phase::Facets => DelotetPhase::Facets,
            Phase::Regions => DelotetPhase::Regions,
            Phase::Round => DelotetPhase::Round,
            Phase::Audit => DelotetPhase::Audit,
            Phase::Write => DelotetPhase::Write,
            Phase::Preserve => DelotetPhase::Preserve,
            Phase::Refine => DelotetPhase::Refine,
            Phase::Optimize => DelotetPhase::Optimize,
        }
    }
}

impl DelotetElement {
    /// The kind of an element and its index.
    pub(super) fn split(element: Option<Element>) -> (DelotetElement, u32) {
        match element {
            None => (DelotetElement::None, crate::INVALID),
            Some(Element::Point(index)) => (DelotetElement::Point, index),
            Some(Element::Segment(index)) => (DelotetElement::Segment, index),
            Some(Element::Facet(index)) => (DelotetElement::Facet, index),
            Some(Element::Hole(index)) => (DelotetElement::Hole, index),
            Some(Element::Region(index)) => (DelotetElement::Region, index),
            Some(Element::Tet(index)) => (DelotetElement::Tet, index),
        }
    }
}

/// Names by number; the texts end with a zero byte.
static STATUS_NAMES: &[(u32, &str)] = &[
    (0, "DELOTET_STATUS_OK\0"),
    (1, "DELOTET_STATUS_INVALID_ARGUMENT\0"),
    (2, "DELOTET_STATUS_UNSUPPORTED\0"),
    (10, "DELOTET_STATUS_NON_FINITE_POINT\0"),
    (11, "DELOTET_STATUS_COORDINATE_RANGE\0"),
    (12, "DELOTET_STATUS_INDEX_OUT_OF_RANGE\0"),
    (14, "DELOTET_STATUS_DEGENERATE_FACET\0"),
    (15, "DELOTET_STATUS_NON_PLANAR_FACET\0"),
    (16, "DELOTET_STATUS_SELF_INTERSECTION\0"),
    (17, "DELOTET_STATUS_DEGENERATE_INPUT\0"),
    (18, "DELOTET_STATUS_SEED_OUTSIDE\0"),
    (19, "DELOTET_STATUS_NOTHING_ENCLOSED\0"),
    (30, "DELOTET_STATUS_CANCELLED\0"),
    (31, "DELOTET_STATUS_STEINER_LIMIT\0"),
    (33, "DELOTET_STATUS_ROUNDING\0"),
    (34, "DELOTET_STATUS_TIME_LIMIT\0"),
    (35, "DELOTET_STATUS_MEMORY_LIMIT\0"),
    (36, "DELOTET_STATUS_TETRAHEDRA_LIMIT\0"),
    (40, "DELOTET_STATUS_OUT_OF_MEMORY\0"),
    (41, "DELOTET_STATUS_TOO_LARGE\0"),
    (50, "DELOTET_STATUS_FILE\0"),
    (51, "DELOTET_STATUS_FORMAT\0"),
    (60, "DELOTET_STATUS_CHECK_FAILED\0"),
    (90, "DELOTET_STATUS_INTERNAL\0"),
];

static ELEMENT_NAMES: &[(u32, &str)] = &[
    (0, "DELOTET_ELEMENT_NONE\0"),
    (1, "DELOTET_ELEMENT_POINT\0"),
    (2, "DELOTET_ELEMENT_SEGMENT\0"),
    (3, "DELOTET_ELEMENT_FACET\0"),
    (4, "DELOTET_ELEMENT_HOLE\0"),
    (5, "DELOTET_ELEMENT_REGION\0"),
    (6, "DELOTET_ELEMENT_TET\0"),
];

static DEFECT_KIND_NAMES: &[(u32, &str)] = &[
    (1, "DELOTET_DEFECT_KIND_NON_FINITE\0"),
    (2, "DELOTET_DEFECT_KIND_COORDINATE_RANGE\0"),
    (3, "DELOTET_DEFECT_KIND_INDEX_OUT_OF_RANGE\0"),
    (4, "DELOTET_DEFECT_KIND_DEGENERATE_SEGMENT\0"),
    (5, "DELOTET_DEFECT_KIND_DEGENERATE_FACET\0"),
    (6, "DELOTET_DEFECT_KIND_RING_INTERSECTION\0"),
    (7, "DELOTET_DEFECT_KIND_RING_NESTING\0"),
    (8, "DELOTET_DEFECT_KIND_NON_PLANAR_FACET\0"),
    (9, "DELOTET_DEFECT_KIND_DUPLICATE_FACET\0"),
    (10, "DELOTET_DEFECT_KIND_SEGMENT_SEGMENT\0"),
    (11, "DELOTET_DEFECT_KIND_SEGMENT_FACET\0"),
    (12, "DELOTET_DEFECT_KIND_FACET_FACET\0"),
    (13, "DELOTET_DEFECT_KIND_OVERLAP\0"),
    (14, "DELOTET_DEFECT_KIND_SEED_ON_FACET\0"),
    (15, "DELOTET_DEFECT_KIND_SEED_OUTSIDE\0"),
    (16, "DELOTET_DEFECT_KIND_OPEN_EDGE\0"),
    (17, "DELOTET_DEFECT_KIND_ROUNDING\0"),
    (18, "DELOTET_DEFECT_KIND_NOT_POSITIVE\0"),
    (19, "DELOTET_DEFECT_KIND_NOT_CONFORMING\0"),
    (20, "DELOTET_DEFECT_KIND_POINT_MOVED\0"),
    (21, "DELOTET_DEFECT_KIND_SEGMENT_MISSING\0"),
    (22, "DELOTET_DEFECT_KIND_FACET_MISSING\0"),
    (23, "DELOTET_DEFECT_KIND_NOT_DELAUNAY\0"),
    (24, "DELOTET_DEFECT_KIND_HULL_OFF_FACETS\0"),
];

static WARNING_KIND_NAMES: &[(u32, &str)] = &[
    (1, "DELOTET_WARNING_KIND_OPEN_EDGE\0"),
    (2, "DELOTET_WARNING_KIND_UNMESHED_FACET\0"),
    (3, "DELOTET_WARNING_KIND_UNMESHED_SEGMENT\0"),
    (4, "DELOTET_WARNING_KIND_UNMESHED_POINT\0"),
    (5, "DELOTET_WARNING_KIND_EQUAL_POINTS\0"),
    (6, "DELOTET_WARNING_KIND_REPEATED_SEED\0"),
    (7, "DELOTET_WARNING_KIND_HOLE_OUTSIDE\0"),
    (8, "DELOTET_WARNING_KIND_UNUSED_VOLUME\0"),
    (9, "DELOTET_WARNING_KIND_NON_PLANAR_FACET\0"),
    (10, "DELOTET_WARNING_KIND_LOST_VALUE\0"),
];

static PHASE_NAMES: &[(u32, &str)] = &[
    (0, "DELOTET_PHASE_READ\0"),
    (1, "DELOTET_PHASE_VALIDATE\0"),
    (2, "DELOTET_PHASE_DELAUNAY\0"),
    (3, "DELOTET_PHASE_SEGMENTS\0"),
    (4, "DELOTET_PHASE_FACETS\0"),
    (5, "DELOTET_PHASE_REGIONS\0"),
    (6, "DELOTET_PHASE_ROUND\0"),
    (7, "DELOTET_PHASE_AUDIT\0"),
    (8, "DELOTET_PHASE_WRITE\0"),
    (9, "DELOTET_PHASE_PRESERVE\0"),
    (10, "DELOTET_PHASE_REFINE\0"),
    (11, "DELOTET_PHASE_OPTIMIZE\0"),
];

/// The name of a number, zero-terminated.
pub(super) fn name_in(table: &'static [(u32, &'static str)], number: u32) -> *const c_char {
    let found = table.iter().find(|entry| entry.0 == number);
    found.map_or("unknown\0", |entry| entry.1).as_ptr().cast()
}

/// Name of a status, such as "DELOTET_STATUS_SELF_INTERSECTION"; "unknown" for other numbers. Static: never NULL, never freed.
#[no_mangle]
pub extern "C" fn delotet_status_name(status: u32) -> *const c_char {
    name_in(STATUS_NAMES, status)
}

/// Name of a kind of element, such as "DELOTET_ELEMENT_FACET"; "unknown" for other numbers. Static: never NULL, never freed.
#[no_mangle]
pub extern "C" fn delotet_element_name(element: u32) -> *const c_char {
    name_in(ELEMENT_NAMES, element)
}

/// Name of a kind of defect, such as "DELOTET_DEFECT_KIND_OVERLAP"; "unknown" for other numbers. Static: never NULL, never freed.
#[no_mangle]
pub extern "C" fn delotet_defect_kind_name(kind: u32) -> *const c_char {
    name_in(DEFECT_KIND_NAMES, kind)
}

/// Name of a kind of warning, such as "DELOTET_WARNING_KIND_OPEN_EDGE"; "unknown" for other numbers. Static: never NULL, never freed.
#[no_mangle]
pub extern "C" fn delotet_warning_kind_name(kind: u32) -> *const c_char {
    name_in(WARNING_KIND_NAMES, kind)
}

/// The fraction of the whole run that is done when `fraction` of `phase` is done, from 0 to 1: for a single progress bar. It never
/// decreases during a run, since phases come in order. The shares of the phases are rough estimates. 0 for unknown phases.
#[no_mangle]
pub extern "C" fn delotet_phase_overall(phase: u32, fraction: f64) -> f64 {
    let known = Phase::ALL.into_iter().find(|&known| DelotetPhase::from(known) as u32 == phase);
    known.map_or(0.0, |phase| phase.overall(if fraction.is_nan() { 0.0 } else { fraction }))
}

/// Name of a phase, such as "DELOTET_PHASE_FACETS"; "unknown" for other numbers. Static: never NULL, never freed.
#[no_mangle]
pub extern "C" fn delotet_phase_name(phase: u32) -> *const c_char {
    name_in(PHASE_NAMES, phase)
}
