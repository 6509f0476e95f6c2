//! Errors and the elements at fault. No C types here: `ffi` translates.
use crate::fallible;
use std::borrow::Cow;
use std::collections::TryReserveError;
use std::fmt;

/// The outcome of a call. The numbers are part of the C ABI: they never change, and the gaps leave room for more.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(i32)]
pub enum Status {
    /// An argument is outside its documented range.
    InvalidArgument = 1,
    /// The request is well-formed, but not supported (a file format, a combination of options).
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
    /// Elements of the PLC cross or overlap outside their common vertices and edges.
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
    /// An invariant failed: a bug in this library. Please report it.
    Internal = 90,
}

impl Status {
    /// Whether nothing else may be tried after this failure: the run was ended by the caller or by a limit of the caller or the machine.
    pub(crate) fn is_final(self) -> bool {
        use Status::{Cancelled, MemoryLimit, OutOfMemory, TetrahedraLimit, TimeLimit, TooLarge};
        matches!(self, Cancelled | TimeLimit | MemoryLimit | TetrahedraLimit | OutOfMemory | TooLarge)
    }
}

/// An element of the input or of the mesh, by its index.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Element {
    /// An input point (in a mesh check: a vertex of the mesh).
    Point(u32),
    /// An input segment.
    Segment(u32),
    /// An input facet.
    Facet(u32),
    /// A hole seed.
    Hole(u32),
    /// A region seed.
    Region(u32),
    /// A tetrahedron of the mesh.
    Tet(u32),
}

/// What kind of defect was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum DefectKind {
    /// A coordinate (or attribute that is a coordinate) is NaN or infinite.
    NonFinite,
    /// A coordinate cannot be scaled into the exact range.
    CoordinateRange,
    /// An index refers to no element.
    IndexOutOfRange,
    /// A segment joins a point with itself or with an equal one.
    DegenerateSegment,
    /// A facet has no area, fewer than three distinct corners, or a ring that is not a polygon.
    DegenerateFacet,
    /// A ring of a facet touches or crosses itself or another ring of the facet.
    RingIntersection,
    /// An inner ring lies outside the outer one, or inside another inner ring.
    RingNesting,
    /// A polygon cannot be triangulated: its projection onto a plane folds over itself.
    NonPlanarFacet,
    /// Two facets cover the same triangle.
    DuplicateFacet,
    /// Two segments cross at an inner point of both.
    SegmentSegment,
    /// A segment (or an edge of a facet) pierces a facet.
    SegmentFacet,
    /// Two facets cross.
    FacetFacet,
    /// Two coplanar facets, or a facet and a segment in it, overlap along an area or a line without sharing it.
    Overlap,
    /// A seed lies exactly on a facet.
    SeedOnFacet,
    /// A seed lies outside the domain.
    SeedOutside,
    /// An edge of only one facet, where a surface that encloses nothing leaks. The elements are its ends, the point its midpoint.
    OpenEdge,
    /// Two elements are too close to each other: a Steiner point needed on the first has no valid position in doubles, and the second is
    /// the element nearest to it.
    Rounding,
    /// A tetrahedron is flat (zero volume) or inverted.
    NotPositive,
    /// A face is shared by more than two tetrahedra, or by two on the same side, or a neighbour is wrong.
    NotConforming,
    /// An input point is missing from the mesh or was moved.
    PointMoved,
    /// A segment is not a union of edges of the mesh.
    SegmentMissing,
    /// A facet is not a union of faces of the mesh.
    FacetMissing,
    /// An unconstrained face is not locally Delaunay.
    NotDelaunay,
    /// A boundary face of the mesh lies on no facet.
    HullOffFacets,
}

/// One defect: kind, the one or two elements involved, and a point that locates it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Defect {
    /// The kind.
    pub kind: DefectKind,
    /// The element at fault.
    pub first: Element,
    /// The other element of a pair.
    pub second: Option<Element>,
    /// A point at or near the defect (rounded where it is an intersection).
    pub point: Option<[f64; 3]>,
}

/// A failure: its status, a readable message, and all elements at fault.
#[allow(clippy::disallowed_methods, reason = "for callers; the library itself never clones it")]
#[derive(Clone, Debug, PartialEq)]
pub struct Error {
    /// The status.
    pub status: Status,
    /// One line in English.
    pub message: Cow<'static, str>,
    /// The defects, at most as many as [`Options::max_defects`](crate::Options::max_defects) allows.
    pub defects: Vec<Defect>,
    /// The number of defects found (`defects` may list fewer).
    pub defect_count: usize,
}

/// The text for an error: static or allocated, or the failure to allocate it.
#[derive(Debug)]
pub struct Message(Result<Cow<'static, str>, TryReserveError>);

impl From<&'static str> for Message {
    fn from(text: &'static str) -> Self {
        Message(Ok(Cow::Borrowed(text)))
    }
}

impl From<String> for Message {
    fn from(text: String) -> Self {
        Message(Ok(Cow::Owned(text)))
    }
}

impl From<fmt::Arguments<'_>> for Message {
    fn from(arguments: fmt::Arguments<'_>) -> Self {
        Message(fallible::text(arguments).map(Cow::Owned))
    }
}

impl Error {
    /// An error without defects. If there is no memory for its text, the error is [`Status::OutOfMemory`].
    pub fn new(status: Status, message: impl Into<Message>) -> Self {
        #[expect(clippy::disallowed_methods, reason = "the conversions to a message are above")]
        match message.into().0 {
            Ok(message) => Error { status, message, defects: Vec::new(), defect_count: 0 },
            Err(short) => Error::from(short),
        }
    }

    /// An error with one defect.
    pub fn with_defect(status: Status, message: impl Into<Message>, defect: Defect) -> Self {
        let mut error = Error::new(status, message);
        if error.status == status {
            match fallible::push(&mut error.defects, defect) {
                Ok(()) => error.defect_count = 1,
                Err(short) => return Error::from(short),
            }
        }
        error
    }

    /// An error that lists `defects`, out of `count` found.
    pub(crate) fn with_defects(status: Status, message: Message, defects: Vec<Defect>, count: usize) -> Self {
        match message.0 {
            Ok(message) => Error { status, message, defects, defect_count: count },
            Err(short) => Error::from(short),
        }
    }

    /// An error for a failed invariant of the engine.
    pub fn internal(message: impl Into<Message>) -> Self {
        Error::new(Status::Internal, message)
    }

    /// The same error with `place` and a colon in front of its message. An out-of-memory error stays as it is.
    #[must_use]
    pub fn at(self, place: fmt::Arguments<'_>) -> Self {
        if self.status == Status::OutOfMemory {
            return self;
        }
        match fallible::text(format_args!("{place}: {}", self.message)) {
            Ok(message) => Error { message: Cow::Owned(message), ..self },
            Err(short) => Error::from(short),
        }
    }
}

/// Counts of defects by kind, in the order in which the kinds were first seen. Allocates nothing.
#[derive(Debug)]
pub(crate) struct KindCounts {
    list: [Option<(DefectKind, usize)>; KindCounts::ROOM],
}

impl Default for KindCounts {
    fn default() -> Self {
        KindCounts { list: [None; KindCounts::ROOM] }
    }
}

impl KindCounts {
    /// Larger than the number of kinds.
    const ROOM: usize = 64;

    /// Counts one defect of a kind.
    pub(crate) fn add(&mut self, kind: DefectKind) {
        let place = self.list.iter_mut().find(|k| k.is_none_or(|k| k.0 == kind));
        if let Some(place) = place {
            *place = Some((kind, place.map_or(1, |k| k.1 + 1)));
        }
    }

    /// Kinds and counts.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (DefectKind, usize)> + '_ {
        self.list.iter().map_while(|&k| k)
    }

    /// `3 open edge, 1 overlap`, with `between` between count and name.
    pub(crate) fn shown(&self, between: &'static str) -> impl fmt::Display + '_ {
        ShownKinds { kinds: self, between }
    }
}

struct ShownKinds<'a> {
    kinds: &'a KindCounts,
    between: &'static str,
}

impl fmt::Display for ShownKinds<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.kinds.iter().enumerate().try_for_each(|(i, (kind, count))| {
            f.write_str(if i == 0 { "" } else { ", " })?;
            write!(f, "{count}{}{}", self.between, kind.name())
        })
    }
}

impl From<TryReserveError> for Error {
    fn from(_: TryReserveError) -> Self {
        Error::new(Status::OutOfMemory, "out of memory")
    }
}

impl fmt::Display for Element {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Element::Point(i) => write!(f, "point {i}"),
            Element::Segment(i) => write!(f, "segment {i}"),
            Element::Facet(i) => write!(f, "facet {i}"),
            Element::Hole(i) => write!(f, "hole {i}"),
            Element::Region(i) => write!(f, "region {i}"),
            Element::Tet(i) => write!(f, "tetrahedron {i}"),
        }
    }
}

impl DefectKind {
    /// The kind in words, as printed in reports.
    pub fn name(self) -> &'static str {
        match self {
            DefectKind::NonFinite => "non-finite coordinate",
            DefectKind::CoordinateRange => "coordinate out of range",
            DefectKind::IndexOutOfRange => "index out of range",
            DefectKind::DegenerateSegment => "degenerate segment",
            DefectKind::DegenerateFacet => "degenerate facet",
            DefectKind::RingIntersection => "ring intersection",
            DefectKind::RingNesting => "ring nesting",
            DefectKind::NonPlanarFacet => "non-planar facet",
            DefectKind::DuplicateFacet => "duplicate facet",
            DefectKind::SegmentSegment => "segment crosses segment",
            DefectKind::SegmentFacet => "segment pierces facet",
            DefectKind::FacetFacet => "facet crosses facet",
            DefectKind::Overlap => "overlap",
            DefectKind::SeedOnFacet => "seed on facet",
            DefectKind::SeedOutside => "seed outside",
            DefectKind::OpenEdge => "open edge",
            DefectKind::Rounding => "too close for doubles",
            DefectKind::NotPositive => "tetrahedron not positive",
            DefectKind::NotConforming => "not conforming",
            DefectKind::PointMoved => "point moved",
            DefectKind::SegmentMissing => "segment missing",
            DefectKind::FacetMissing => "facet missing",
            DefectKind::NotDelaunay => "not locally Delaunay",
            DefectKind::HullOffFacets => "boundary face on no facet",
        }
    }
}

impl fmt::Display for Defect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.kind.name(), self.first)?;
        if let Some(second) = self.second {
            write!(f, " and {second}")?;
        }
        if let Some([x, y, z]) = self.point {
            write!(f, " at ({x}, {y}, {z})")?;
        }
        Ok(())
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Error {}
