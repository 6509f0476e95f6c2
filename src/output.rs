//! The result: flat arrays in doubles, input points first, with the origin of everything.
use crate::progress::Phase;
use crate::warning::Warnings;

mod dropped;
pub use dropped::Dropped;

/// A Steiner point and where it lies: on an edge of the input, or inside ([`SteinerPoint::INSIDE`]; on no segment then).
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct SteinerPoint {
    /// Ends of the input edge (input point indices) that the point was put on: exactly `a + t (b − a)`. Both are
    /// [`INVALID`](crate::INVALID) for a point inside, which lies on no edge ([`TetMesh::preserved`]).
    pub ends: [u32; 2],
    /// The parameter, up to the point's [`SteinerTerm`]s, which hardly any point has; 0 for a point inside.
    pub t: f64,
    /// The input segment it lies on, or [`INVALID`](crate::INVALID) if the edge belongs to facets only.
    pub segment: u32,
    /// The double coordinates in `points` are exactly `a + t (b − a)`; false: they are rounded (or moved by the rounding step).
    /// A point inside lies where its doubles are: true.
    pub exact: bool,
}

impl SteinerPoint {
    /// A point on no edge, facet or segment of the input ([`Mode::Preserve`](crate::Mode::Preserve)): it lies exactly where
    /// its doubles are.
    pub const INSIDE: SteinerPoint =
        SteinerPoint { ends: [crate::INVALID; 2], t: 0.0, segment: crate::INVALID, exact: true };

    /// Whether the point lies on no edge of the input.
    pub fn is_inside(&self) -> bool {
        self.ends == [crate::INVALID; 2]
    }
}

/// A term of a Steiner point's parameter beyond [`SteinerPoint::t`]: the exact parameter is the sum. Segments that run
/// so close to each other that a double is too coarse have such points.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct SteinerTerm {
    /// Index of the Steiner point (in `steiner`).
    pub steiner: u32,
    /// The term.
    pub value: f64,
}

/// A piece of a facet: a triangle that is a face of the mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub struct Subface {
    /// The corners.
    pub corners: [u32; 3],
    /// The input facet it lies on.
    pub facet: u32,
    /// That facet's marker.
    pub marker: i32,
    /// The tetrahedra on both sides. The first is that of the lower region (by its index), within one region that of the lower
    /// index; the second is [`INVALID`](crate::INVALID) on the boundary. The corners' normal `(b − a) × (c − a)` points from
    /// the first to the second: from the lower region to the higher, and outward on the boundary. Both are `INVALID` in
    /// [`TetMesh::unmeshed_subfaces`] only.
    pub tets: [u32; 2],
}

/// A piece of a segment or of a facet's edge: an edge of the mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub struct Subsegment {
    /// The ends.
    pub ends: [u32; 2],
    /// The input segment it lies on, or [`INVALID`](crate::INVALID) for an edge of facets.
    pub segment: u32,
    /// The segment's marker, 0 for an edge of facets.
    pub marker: i32,
}

/// A region of the mesh: tetrahedra that are connected through unconstrained faces and share a seed (or have none).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    /// The attribute of the seed; for unseeded regions a number of its own, not used by any seed.
    pub attribute: f64,
    /// Index of the region seed, or [`INVALID`](crate::INVALID).
    pub seed: u32,
    /// The volume bound of the seed (kept for refinement), if positive.
    pub max_volume: Option<f64>,
}

/// What a mesh is beyond being valid, by the mode in which it was made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Guarantee {
    /// Every facet and segment is a union of faces and edges, and all other faces are locally Delaunay.
    #[default]
    ConstrainedDelaunay,
    /// The Delaunay tetrahedralization of the points: facets and segments play no part.
    Delaunay,
    /// The surface is kept as it was ([`Preserve::All`](crate::Preserve::All)).
    Preserved,
    /// The outer boundary is kept as it was ([`Preserve::Outer`](crate::Preserve::Outer)).
    PreservedOuter,
}

/// A flip of two facets' triangles that facet merging made before meshing: edge `old` became edge `new`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub struct FacetFlip {
    /// The removed edge (input point indices).
    pub old: [u32; 2],
    /// The edge in its place.
    pub new: [u32; 2],
    /// The two facets (input facet indices).
    pub facets: [u32; 2],
}

/// What keeping the boundary took ([`Mode::Preserve`](crate::Mode::Preserve)).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PreserveStatistics {
    /// Edges of the surface missing from the Delaunay tetrahedralization of the points.
    pub missing_edges: u64,
    /// Triangles of the surface missing from it.
    pub missing_faces: u64,
    /// Edges and faces recovered by reconnecting tetrahedra alone.
    pub by_reconnection: u64,
    /// Edges and faces recovered with the help of points inside.
    pub by_interior_points: u64,
    /// Edges and faces recovered by points on them, which were taken away again.
    pub by_splits: u64,
    /// Points on the surface taken away without a replacement.
    pub deleted: u64,
    /// Points on the surface taken away with points inside in their place.
    pub relocated: u64,
    /// Points added inside that are left.
    pub interior: u64,
    /// Points left on internal facets and segments ([`Preserve::Outer`](crate::Preserve::Outer)).
    pub on_internal_facets: u64,
}

/// Counts and costs of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Statistics {
    /// Steiner points on segments and facet edges.
    pub steiner: u64,
    /// Those whose double coordinates are exact.
    pub steiner_exact: u64,
    /// Those whose nearest double was not valid and that were moved to another position.
    pub steiner_moved: u64,
    /// Tetrahedra that took the place of ones that no doubles made positive.
    pub replaced: u64,
    /// Input points that equal an earlier one.
    pub duplicate_points: u64,
    /// Segments missing from the Delaunay tetrahedralization of the points.
    pub missing_segments: u64,
    /// Missing regions that facet recovery filled.
    pub missing_regions: u64,
    /// Largest number of bytes that the kernel's arrays held.
    pub peak_bytes: u64,
    /// What keeping the boundary took; all zero in other modes.
    pub preserve: PreserveStatistics,
    /// Seconds per phase, indexed by [`Phase`].
    pub seconds: [f64; Phase::COUNT],
}

/// A tetrahedral mesh in doubles.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TetMesh {
    /// All points: the input points first, bit for bit and in input order, then the Steiner points.
    pub points: Vec<[f64; 3]>,
    /// How many of `points` are input points.
    pub input_point_count: u32,
    /// For each input point the first input point equal to it (itself, if there is none): tetrahedra use only that one.
    pub point_alias: Vec<u32>,
    /// The tetrahedra, all positive.
    pub tets: Vec<[u32; 4]>,
    /// Per tetrahedron and face (opposite each vertex) the tetrahedron beyond, or [`INVALID`](crate::INVALID).
    pub neighbors: Vec<[u32; 4]>,
    /// Per tetrahedron an index into `regions`.
    pub tet_region: Vec<u32>,
    /// The regions.
    pub regions: Vec<Region>,
    /// Faces on facets.
    pub subfaces: Vec<Subface>,
    /// Edges on segments and facet edges.
    pub subsegments: Vec<Subsegment>,
    /// Pieces of facets that bound no tetrahedron, since all around them was carved: no faces of the mesh.
    pub unmeshed_subfaces: Vec<Subface>,
    /// Pieces of segments and facet edges that are edges of no tetrahedron.
    pub unmeshed_subsegments: Vec<Subsegment>,
    /// Points that no tetrahedron has, ascending: those that equal an earlier point, and those around which all was carved.
    pub unmeshed_points: Vec<u32>,
    /// Set if these points were left out ([`Options::drop_unmeshed_points`](crate::Options::drop_unmeshed_points)): all indices of
    /// points are then those of what is left, but those of `facet_flips`, which stay the input's.
    pub dropped: Option<Dropped>,
    /// One per Steiner point, in the order of `points`.
    pub steiner: Vec<SteinerPoint>,
    /// Terms of parameters that are no doubles, in the order of `steiner`, each point's largest first.
    pub steiner_terms: Vec<SteinerTerm>,
    /// Tetrahedra that took the place of ones that no doubles made positive, ascending: almost flat facets force them. They are positive in
    /// `points`, like all, but not necessarily Delaunay, nor positive in the exact positions of Steiner points. Where no doubles were
    /// found at all, the mesh is [`preserved`](Self::preserved), and these are the tetrahedra at faces that are not locally Delaunay.
    pub replaced: Vec<u32>,
    /// Points (indices into `points`) without a valid position in doubles; empty unless
    /// [`Options::exact_form`](crate::Options::exact_form) was set and rounding failed.
    pub crowded: Vec<u32>,
    /// The facet flips made by merging, in order.
    pub facet_flips: Vec<FacetFlip>,
    /// The mesh is the convex hull's (nothing outside was carved).
    pub hull_kept: bool,
    /// What the mesh is beyond being valid.
    pub guarantee: Guarantee,
    /// The surface's triangles are faces, its segments and the edges of its polygons edges: Steiner points lie inside, and faces are not
    /// necessarily Delaunay ([`Mode::Preserve`](crate::Mode::Preserve)). With [`Preserve::Outer`](crate::Preserve::Outer) that
    /// holds for the outer boundary.
    pub preserved: bool,
    /// What the caller should know: leaks, parts of the input that are not meshed, seeds without effect. At most
    /// [`Options::max_defects`](crate::Options::max_defects) of a kind are listed.
    pub warnings: Warnings,
    /// Counts and costs.
    pub statistics: Statistics,
}
