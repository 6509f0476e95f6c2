//! The result: flat arrays in doubles, input points first, with the origin of every element.
use crate::error::Error;
use crate::fallible;
use crate::progress::Phase;
use crate::warning::Warnings;

mod arrays;
mod dropped;
mod lift;
mod statistics;
pub use arrays::MeshArrays;
pub use dropped::Dropped;
pub use lift::Lift;
pub use statistics::{OptimizeStatistics, RefineStatistics};

/// A Steiner point and where it lies: on an input edge, on an input facet, or inside and on neither ([`SteinerPoint::INSIDE`]).
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct SteinerPoint {
    /// Ends a and b of the input edge (input point indices): the point lies on it at exactly `a + t (b − a)`. On a facet, two points of its
    /// plane: see [`third`](Self::third). Both are [`INVALID`](crate::INVALID) for a point inside.
    pub ends: [u32; 2],
    /// The parameter, up to the point's [`SteinerTerm`]s, which few points have; 0 for a point inside.
    pub t: f64,
    /// The input segment it lies on, or [`INVALID`](crate::INVALID) if the edge belongs to facets only, and elsewhere.
    pub segment: u32,
    /// True if the double coordinates in `points` are the exact position, and for a point inside. False if they were rounded, or moved
    /// by the rounding step.
    pub exact: bool,
    /// For a point on a facet, a third point c of its plane: the point lies at exactly `a + t (b − a) + u (c − a)`. There `ends` and `third`
    /// are [`INVALID`](crate::INVALID) if its doubles lie in the plane themselves and are its position. `INVALID` elsewhere.
    pub third: u32,
    /// The input facet it lies on (inside, not on an edge), or [`INVALID`](crate::INVALID).
    pub facet: u32,
    /// The second parameter of a point on a facet; 0 elsewhere.
    pub u: f64,
}

impl SteinerPoint {
    /// A point on no edge, facet or segment of the input: it lies exactly at its double coordinates.
    pub const INSIDE: SteinerPoint = SteinerPoint {
        ends: [crate::INVALID; 2],
        t: 0.0,
        segment: crate::INVALID,
        exact: true,
        third: crate::INVALID,
        facet: crate::INVALID,
        u: 0.0,
    };

    /// Whether the point lies on no input edge and no facet.
    pub fn is_inside(&self) -> bool {
        self.ends == [crate::INVALID; 2] && self.facet == crate::INVALID
    }

    /// The input points that its position refers to.
    pub(crate) fn parents(&self) -> impl Iterator<Item = u32> {
        self.ends.into_iter().chain([self.third]).filter(|&v| v != crate::INVALID)
    }

    /// The same, to be changed.
    pub(crate) fn parents_mut(&mut self) -> impl Iterator<Item = &mut u32> {
        self.ends.iter_mut().chain([&mut self.third]).filter(|v| **v != crate::INVALID)
    }

    /// Whether the point lies on an input edge.
    pub fn is_on_edge(&self) -> bool {
        self.ends != [crate::INVALID; 2] && self.facet == crate::INVALID
    }
}

/// A further term of a Steiner point's parameter: the exact parameter is the sum of [`SteinerPoint::t`] and all terms. Points have terms on
/// segments that run so close to each other that one double is too coarse.
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
    /// The tetrahedra on both sides: first the one in the region with the lower index or, within one region, the one with the lower index.
    /// The second is [`INVALID`](crate::INVALID) on the boundary. The normal `(b − a) × (c − a)` points from the first to the second: from
    /// the lower region to the higher, and outward on the boundary. Both are `INVALID` in [`TetMesh::unmeshed_subfaces`] only.
    pub tets: [u32; 2],
}

/// A piece of a segment or of a facet edge: an edge of the mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub struct Subsegment {
    /// The ends.
    pub ends: [u32; 2],
    /// The input segment it lies on, or [`INVALID`](crate::INVALID) for a facet edge that is no segment.
    pub segment: u32,
    /// The segment's marker, or 0 if there is no segment.
    pub marker: i32,
}

/// A region of the mesh: tetrahedra that are connected through unconstrained faces and share a seed (or have none).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    /// The attribute of the seed; a region without a seed has a number of its own that no seed uses.
    pub attribute: f64,
    /// Index of the region seed, or [`INVALID`](crate::INVALID).
    pub seed: u32,
    /// The volume bound of the seed (kept for refinement), if positive.
    pub max_volume: Option<f64>,
}

/// What a mesh guarantees beyond validity, by the mode in which it was made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Guarantee {
    /// Every facet and segment is a union of faces and edges, and all other faces are locally Delaunay.
    #[default]
    ConstrainedDelaunay,
    /// Every facet and segment is a union of faces and edges: such a mesh after optimisation ([`Options::optimize`](crate::Options::optimize)).
    Conforming,
    /// The Delaunay tetrahedralization of the points: facets and segments are ignored.
    Delaunay,
    /// The weighted Delaunay (regular) tetrahedralization of weighted points ([`Lift`]).
    WeightedDelaunay,
    /// The surface is kept as it is in the input ([`Preserve::All`](crate::Preserve::All)).
    Preserved,
    /// The outer boundary is kept as it is in the input ([`Preserve::Outer`](crate::Preserve::Outer)).
    PreservedOuter,
    /// A given mesh ([`mesh_from_arrays`](crate::mesh_from_arrays)), or one refined or improved that kept no surface before: facets and
    /// segments are unions of faces and edges.
    Given,
}

/// A flip of two facet triangles, made by facet merging before meshing: edge `old` became edge `new`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub struct FacetFlip {
    /// The removed edge (input point indices).
    pub old: [u32; 2],
    /// The edge that replaces it.
    pub new: [u32; 2],
    /// The two facets (input facet indices).
    pub facets: [u32; 2],
}

/// Counts of what it took to keep the surface ([`Mode::Preserve`](crate::Mode::Preserve)).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PreserveStatistics {
    /// Edges of the surface missing from the Delaunay tetrahedralization of the points.
    pub missing_edges: u64,
    /// Triangles of the surface missing from that tetrahedralization.
    pub missing_faces: u64,
    /// Edges and faces recovered by reconnecting tetrahedra alone.
    pub by_reconnection: u64,
    /// Edges and faces recovered with the help of points inside.
    pub by_interior_points: u64,
    /// Edges and faces recovered by points on them that were removed again.
    pub by_splits: u64,
    /// Points on the surface removed without a replacement.
    pub deleted: u64,
    /// Points on the surface replaced by points inside.
    pub relocated: u64,
    /// Points added inside for the surface that remain in the mesh, without those of filling and optimisation.
    pub interior: u64,
    /// Points left on internal facets and segments ([`Preserve::Outer`](crate::Preserve::Outer)).
    pub on_internal_facets: u64,
}

/// Counts and costs of a run.
#[allow(clippy::disallowed_methods, reason = "for callers; the library itself never clones it")]
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Statistics {
    /// Steiner points on segments and facet edges, without those of refinement.
    pub steiner: u64,
    /// Steiner points on segments, facet edges and facets whose double coordinates are exact, with those of refinement.
    pub steiner_exact: u64,
    /// Steiner points moved to another position because the nearest doubles were not valid.
    pub steiner_moved: u64,
    /// Tetrahedra that replace ones for which no double coordinates gave a positive volume.
    pub replaced: u64,
    /// Input points that equal an earlier one.
    pub duplicate_points: u64,
    /// Segments missing from the Delaunay tetrahedralization of the points.
    pub missing_segments: u64,
    /// Missing regions that facet recovery filled.
    pub missing_regions: u64,
    /// Peak size of the engine's arrays in bytes.
    pub peak_bytes: u64,
    /// What it took to keep the surface; all zero in other modes.
    pub preserve: PreserveStatistics,
    /// What it took to fill and refine the mesh; all zero if nothing was.
    pub refine: RefineStatistics,
    /// What optimisation did; all zero if there was none.
    pub optimize: OptimizeStatistics,
    /// Seconds per phase, indexed by [`Phase`].
    pub seconds: [f64; Phase::COUNT],
}

/// A tetrahedral mesh in doubles.
#[allow(clippy::disallowed_methods, reason = "for callers; the library itself never clones it")]
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TetMesh {
    /// All points: the input points first, bit for bit and in input order, then the Steiner points.
    pub points: Vec<[f64; 3]>,
    /// The number of `points` that are input points.
    pub input_point_count: u32,
    /// For each input point the first input point with the same coordinates (itself if there is no earlier one): tetrahedra use only that
    /// one.
    pub point_alias: Vec<u32>,
    /// The tetrahedra, all positive.
    pub tets: Vec<[u32; 4]>,
    /// For each tetrahedron and vertex i the tetrahedron across the face opposite that vertex, or [`INVALID`](crate::INVALID).
    pub neighbors: Vec<[u32; 4]>,
    /// For each tetrahedron an index into `regions`.
    pub tet_region: Vec<u32>,
    /// The regions.
    pub regions: Vec<Region>,
    /// Faces on facets.
    pub subfaces: Vec<Subface>,
    /// Edges on segments and facet edges.
    pub subsegments: Vec<Subsegment>,
    /// Pieces of facets that bound no tetrahedron because everything around them was carved. They are not faces of the mesh.
    pub unmeshed_subfaces: Vec<Subface>,
    /// Pieces of segments and facet edges that are edges of no tetrahedron.
    pub unmeshed_subsegments: Vec<Subsegment>,
    /// Points that belong to no tetrahedron, in ascending order: those that equal an earlier point, and those around which everything was
    /// carved.
    pub unmeshed_points: Vec<u32>,
    /// Those of them that other points hide by their weights ([`Lift`]), in ascending order. (Once they are left out, `dropped` says so.)
    pub hidden_points: Vec<u32>,
    /// The weights of `points` that counted. Of equal points the first has the largest weight (the smallest height).
    pub lift: Lift,
    /// Set if these points were left out ([`Options::drop_unmeshed_points`](crate::Options::drop_unmeshed_points)): all point indices then
    /// refer to the remaining points, except those in `facet_flips`, which refer to the input.
    pub dropped: Option<Dropped>,
    /// One per Steiner point, in the order of `points`.
    pub steiner: Vec<SteinerPoint>,
    /// Further terms of parameters that one double cannot hold, in the order of `steiner`, each point's largest term first.
    pub steiner_terms: Vec<SteinerTerm>,
    /// Tetrahedra that replace ones for which no double coordinates gave a positive volume, in ascending order: nearly flat facets force
    /// them. They are positive in `points`, like all others, but not necessarily Delaunay, nor positive at the exact positions of Steiner
    /// points. If no valid doubles were found at all, the mesh is [`preserved`](Self::preserved), and these are the tetrahedra at faces
    /// that are not locally Delaunay.
    pub replaced: Vec<u32>,
    /// Points (indices into `points`) without a valid position in doubles; empty unless
    /// [`Options::exact_form`](crate::Options::exact_form) was set and rounding failed.
    pub crowded: Vec<u32>,
    /// The flips made by facet merging, in order.
    pub facet_flips: Vec<FacetFlip>,
    /// The mesh fills the convex hull: nothing outside the surface was carved.
    pub hull_kept: bool,
    /// The radius-edge ratio that was asked for ([`Options::quality`](crate::Options::quality)), if one was; see
    /// [`skinny_tets`](crate::query::quality::skinny_tets).
    pub ratio: Option<f64>,
    /// What the mesh guarantees beyond validity.
    pub guarantee: Guarantee,
    /// The triangles of the surface are faces, its segments and the edges of its polygons are edges: Steiner points lie inside, and faces are
    /// not necessarily Delaunay ([`Mode::Preserve`](crate::Mode::Preserve)). With [`Preserve::Outer`](crate::Preserve::Outer) this holds for
    /// the outer boundary.
    pub preserved: bool,
    /// Warnings about leaks, parts of the input that are not meshed, and seeds without effect. At most
    /// [`Options::max_defects`](crate::Options::max_defects) of each kind are listed.
    pub warnings: Warnings,
    /// Counts and costs.
    pub statistics: Statistics,
}

impl TetMesh {
    /// A copy; unlike `clone` it returns an error if memory runs out.
    ///
    /// # Errors
    /// [`Status::OutOfMemory`](crate::Status::OutOfMemory).
    pub fn try_clone(&self) -> Result<TetMesh, Error> {
        // By name, so that a new field cannot be forgotten here.
        let TetMesh {
            points,
            input_point_count,
            point_alias,
            tets,
            neighbors,
            tet_region,
            regions,
            subfaces,
            subsegments,
            unmeshed_subfaces,
            unmeshed_subsegments,
            unmeshed_points,
            hidden_points,
            lift,
            dropped,
            steiner,
            steiner_terms,
            replaced,
            crowded,
            facet_flips,
            hull_kept,
            ratio,
            guarantee,
            preserved,
            warnings,
            statistics,
        } = self;
        Ok(TetMesh {
            points: fallible::copied(points)?,
            input_point_count: *input_point_count,
            point_alias: fallible::copied(point_alias)?,
            tets: fallible::copied(tets)?,
            neighbors: fallible::copied(neighbors)?,
            tet_region: fallible::copied(tet_region)?,
            regions: fallible::copied(regions)?,
            subfaces: fallible::copied(subfaces)?,
            subsegments: fallible::copied(subsegments)?,
            unmeshed_subfaces: fallible::copied(unmeshed_subfaces)?,
            unmeshed_subsegments: fallible::copied(unmeshed_subsegments)?,
            unmeshed_points: fallible::copied(unmeshed_points)?,
            hidden_points: fallible::copied(hidden_points)?,
            lift: lift.try_clone()?,
            dropped: dropped.as_ref().map(Dropped::try_clone).transpose()?,
            steiner: fallible::copied(steiner)?,
            steiner_terms: fallible::copied(steiner_terms)?,
            replaced: fallible::copied(replaced)?,
            crowded: fallible::copied(crowded)?,
            facet_flips: fallible::copied(facet_flips)?,
            hull_kept: *hull_kept,
            ratio: *ratio,
            guarantee: *guarantee,
            preserved: *preserved,
            warnings: warnings.try_clone()?,
            statistics: Statistics { ..*statistics },
        })
    }
}
