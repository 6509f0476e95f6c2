//! Arrays as C sees them. Plain arrays: pointer and count. Records: pointer, count and stride (the bytes from one record to the next), so
//! that fields can be appended to records without breaking compiled programs. The views themselves are passed by value and therefore
//! frozen. Records have the layout of the Rust types behind them, which is asserted here.
use crate::output::{FacetFlip, SteinerPoint, SteinerTerm, Subface, Subsegment};
use crate::plc::{RegionSeed, Segment};
use crate::query::{Edge, Face};
use std::mem::offset_of;

/// The index that means "none": no neighbour, no parent, not found. Valid indices are smaller. (`delotet.h.in` defines it for C,
/// with the right suffix.)
/// cbindgen:ignore
pub const DELOTET_INVALID_INDEX: u32 = 0xFFFF_FFFF;
const _: () = assert!(DELOTET_INVALID_INDEX == crate::INVALID);

macro_rules! view {
    ($name:ident, $element:ty, $from:ty) => {
        impl $name {
            /// A view of a list; null and 0 if it is empty.
            pub(super) fn new(list: &[$from]) -> Self {
                let data = if list.is_empty() { std::ptr::null() } else { list.as_ptr().cast::<$element>() };
                $name { data, count: list.len() }
            }
        }
    };
}

macro_rules! records {
    ($name:ident, $record:ty, $from:ty) => {
        impl $name {
            /// A view of records; null and 0 if there are none.
            pub(super) fn new(list: &[$from]) -> Self {
                let first = if list.is_empty() { std::ptr::null() } else { list.as_ptr().cast::<$record>() };
                $name { first, count: list.len(), stride: size_of::<$record>() }
            }
        }
    };
}
pub(super) use records;

/// Borrowed points; NULL and 0 if there are none.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetPointsView {
    /// #points by 3 doubles: x y z per point.
    pub data: *const f64,
    /// Number of points.
    pub count: usize,
}
view!(DelotetPointsView, f64, [f64; 3]);

/// Borrowed rows of doubles; NULL and zeros if there are none.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetDoublesView {
    /// #rows by `width` doubles.
    pub data: *const f64,
    /// Number of rows.
    pub count: usize,
    /// Number of doubles per row.
    pub width: usize,
}

/// Borrowed markers; NULL and 0 if there are none.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetMarkersView {
    /// `count` integers.
    pub data: *const i32,
    /// Number of elements.
    pub count: usize,
}
view!(DelotetMarkersView, i32, i32);

/// Borrowed indices; NULL and 0 if there are none.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetIndicesView {
    /// `count` indices.
    pub data: *const u32,
    /// Number of elements.
    pub count: usize,
}
view!(DelotetIndicesView, u32, u32);

/// Borrowed rows of indices; NULL and zeros if there are none.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetIndexRowsView {
    /// #rows by `width` indices.
    pub data: *const u32,
    /// Number of rows.
    pub count: usize,
    /// Number of indices per row.
    pub width: usize,
}

/// Borrowed quadruples of indices, one per tetrahedron; NULL and 0 if there are none.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetTetsView {
    /// #tetrahedra by 4 indices.
    pub data: *const u32,
    /// Number of tetrahedra.
    pub count: usize,
}
view!(DelotetTetsView, u32, [u32; 4]);

/// A segment of the input.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetSegment {
    /// The ends.
    pub ends: [u32; 2],
    /// The marker.
    pub marker: i32,
}

/// Borrowed segments; NULL and 0 if there are none.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetSegmentsView {
    /// The first of `count` segments; DELOTET_AT(DelotetSegment, view, i) is the i-th.
    pub first: *const DelotetSegment,
    /// Number of elements.
    pub count: usize,
    /// Bytes from one element to the next.
    pub stride: usize,
}
records!(DelotetSegmentsView, DelotetSegment, Segment);

/// A region seed of the input.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DelotetRegionSeed {
    /// x y z of a point inside the region.
    pub point: [f64; 3],
    /// The attribute of the tetrahedra there.
    pub attribute: f64,
    /// Bound on the volume of a tetrahedron there; 0 if there is none.
    pub max_volume: f64,
}

/// Borrowed region seeds; NULL and 0 if there are none.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetRegionSeedsView {
    /// The first of `count` seeds; DELOTET_AT(DelotetRegionSeed, view, i) is the i-th.
    pub first: *const DelotetRegionSeed,
    /// Number of elements.
    pub count: usize,
    /// Bytes from one element to the next.
    pub stride: usize,
}
records!(DelotetRegionSeedsView, DelotetRegionSeed, DelotetRegionSeed);

impl From<&RegionSeed> for DelotetRegionSeed {
    fn from(seed: &RegionSeed) -> Self {
        let max_volume = seed.max_volume.unwrap_or(0.0);
        DelotetRegionSeed { point: seed.point, attribute: seed.attribute, max_volume }
    }
}

/// A region of the mesh: tetrahedra that are connected through unconstrained faces and share a seed (or have none).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DelotetRegion {
    /// The attribute of the seed; a region without a seed has a number of its own that no seed uses.
    pub attribute: f64,
    /// The volume bound of the seed; 0 if it has none.
    pub max_volume: f64,
    /// Index of the region seed, or DELOTET_INVALID_INDEX.
    pub seed: u32,
}

/// Borrowed regions; NULL and 0 if there are none.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetRegionsView {
    /// The first of `count` regions; DELOTET_AT(DelotetRegion, view, i) is the i-th.
    pub first: *const DelotetRegion,
    /// Number of elements.
    pub count: usize,
    /// Bytes from one element to the next.
    pub stride: usize,
}
records!(DelotetRegionsView, DelotetRegion, DelotetRegion);

/// A piece of a facet: a triangle that is a face of the mesh.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetSubface {
    /// The corners.
    pub corners: [u32; 3],
    /// The input facet it lies on (one of them, if coplanar neighbours with equal markers are meshed as one facet).
    pub facet: u32,
    /// That facet's marker.
    pub marker: i32,
    /// The tetrahedra on both sides: first the one in the region with the lower index or, within one region, the one with the lower index.
    /// The second is DELOTET_INVALID_INDEX on the boundary. `(b - a) x (c - a)` points from the first to the second: from the lower region
    /// to the higher, and outward on the boundary.
    pub tets: [u32; 2],
}

/// Borrowed subfaces; NULL and 0 if there are none.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetSubfacesView {
    /// The first of `count` subfaces; DELOTET_AT(DelotetSubface, view, i) is the i-th.
    pub first: *const DelotetSubface,
    /// Number of elements.
    pub count: usize,
    /// Bytes from one element to the next.
    pub stride: usize,
}
records!(DelotetSubfacesView, DelotetSubface, Subface);

/// A piece of a segment or of a facet edge: an edge of the mesh.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetSubsegment {
    /// The ends.
    pub ends: [u32; 2],
    /// The input segment it lies on, or DELOTET_INVALID_INDEX for a facet edge that is no segment.
    pub segment: u32,
    /// The segment's marker, or 0 if there is no segment.
    pub marker: i32,
}

/// Borrowed subsegments; NULL and 0 if there are none.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetSubsegmentsView {
    /// The first of `count` subsegments; DELOTET_AT(DelotetSubsegment, view, i) is the i-th.
    pub first: *const DelotetSubsegment,
    /// Number of elements.
    pub count: usize,
    /// Bytes from one element to the next.
    pub stride: usize,
}
records!(DelotetSubsegmentsView, DelotetSubsegment, Subsegment);

/// A Steiner point and where it lies: on an input edge, on an input facet, or inside, exactly at its double coordinates.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetSteinerPoint {
    /// Input points a and b, the ends of the input edge; the point lies on it at exactly a + t (b - a). On a facet, two points of its plane:
    /// see `third`. Both are DELOTET_INVALID_INDEX for a point inside.
    pub ends: [u32; 2],
    /// The parameter t; 0 for a point inside. The few parameters that one double cannot hold have further terms in
    /// delotet_mesh_steiner_terms().
    pub t: f64,
    /// The input segment it lies on, or DELOTET_INVALID_INDEX if the edge belongs to facets only or the point lies on no edge.
    pub segment: u32,
    /// True if its coordinates are its exact position, and for a point inside. False if they were rounded, or moved to keep every
    /// tetrahedron positive.
    pub exact: bool,
    /// For a point on a facet, input point c, a third one of its plane: the point lies at exactly a + t (b - a) + u (c - a). There `ends`
    /// and `third` are DELOTET_INVALID_INDEX if its coordinates lie in the plane themselves and are its position. DELOTET_INVALID_INDEX
    /// elsewhere.
    pub third: u32,
    /// The input facet it lies on (inside, not on an edge), or DELOTET_INVALID_INDEX.
    pub facet: u32,
    /// The second parameter of a point on a facet; 0 elsewhere.
    pub u: f64,
}

/// Borrowed Steiner points; NULL and 0 if there are none.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetSteinerView {
    /// The first of `count` Steiner points; DELOTET_AT(DelotetSteinerPoint, view, i) is the i-th.
    pub first: *const DelotetSteinerPoint,
    /// Number of elements.
    pub count: usize,
    /// Bytes from one element to the next.
    pub stride: usize,
}
records!(DelotetSteinerView, DelotetSteinerPoint, SteinerPoint);

/// A further term of a Steiner point's parameter: the exact parameter is the sum of `t` and its terms.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetSteinerTerm {
    /// Index into delotet_mesh_steiner_points().
    pub steiner: u32,
    /// The term.
    pub value: f64,
}

/// Borrowed terms; NULL and 0 if there are none.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetSteinerTermsView {
    /// The first of `count` terms; DELOTET_AT(DelotetSteinerTerm, view, i) is the i-th.
    pub first: *const DelotetSteinerTerm,
    /// Number of elements.
    pub count: usize,
    /// Bytes from one element to the next.
    pub stride: usize,
}
records!(DelotetSteinerTermsView, DelotetSteinerTerm, SteinerTerm);

/// A flip of two facet triangles, made by facet merging before meshing.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetFacetFlip {
    /// The removed edge (input points).
    pub old_ends: [u32; 2],
    /// The edge that replaces it.
    pub new_ends: [u32; 2],
    /// The two facets.
    pub facets: [u32; 2],
}

/// Borrowed facet flips; NULL and 0 if there are none.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetFacetFlipsView {
    /// The first of `count` flips; DELOTET_AT(DelotetFacetFlip, view, i) is the i-th.
    pub first: *const DelotetFacetFlip,
    /// Number of elements.
    pub count: usize,
    /// Bytes from one element to the next.
    pub stride: usize,
}
records!(DelotetFacetFlipsView, DelotetFacetFlip, FacetFlip);

/// A face of the mesh.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetFace {
    /// The corners; `(b - a) x (c - a)` points from `tets[0]` to `tets[1]`.
    pub corners: [u32; 3],
    /// The tetrahedra on both sides, the smaller index first, or in the order of the subface if it is one; the second is
    /// DELOTET_INVALID_INDEX on the boundary.
    pub tets: [u32; 2],
    /// Its subface, or DELOTET_INVALID_INDEX if it is not constrained.
    pub subface: u32,
    /// The marker of its subface, or 0.
    pub marker: i32,
}

/// Borrowed faces; NULL and 0 if there are none.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetFacesView {
    /// The first of `count` faces; DELOTET_AT(DelotetFace, view, i) is the i-th.
    pub first: *const DelotetFace,
    /// Number of elements.
    pub count: usize,
    /// Bytes from one element to the next.
    pub stride: usize,
}
records!(DelotetFacesView, DelotetFace, Face);

/// An edge of the mesh.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetEdge {
    /// The ends, the smaller first.
    pub ends: [u32; 2],
    /// A tetrahedron that has this edge.
    pub tet: u32,
    /// Its subsegment, or DELOTET_INVALID_INDEX if it is not constrained.
    pub subsegment: u32,
    /// The marker of its subsegment, or 0.
    pub marker: i32,
}

/// Borrowed edges; NULL and 0 if there are none.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetEdgesView {
    /// The first of `count` edges; DELOTET_AT(DelotetEdge, view, i) is the i-th.
    pub first: *const DelotetEdge,
    /// Number of elements.
    pub count: usize,
    /// Bytes from one element to the next.
    pub stride: usize,
}
records!(DelotetEdgesView, DelotetEdge, Edge);

/// Borrowed second-order nodes and tetrahedra.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetSecondOrderView {
    /// #nodes by 3 doubles: the mid-edge nodes, one per edge in the order of delotet_mesh_edges(). Node i has the index
    /// #points + i.
    pub nodes: *const f64,
    /// Number of mid-edge nodes.
    pub node_count: usize,
    /// #tetrahedra by 10 indices: four corners, then six mid-edge nodes.
    pub tets: *const u32,
    /// Number of tetrahedra.
    pub tet_count: usize,
}

impl DelotetDoublesView {
    /// A view of rows of `width` numbers.
    pub(super) fn new(list: &[f64], width: usize) -> Self {
        match list.len().checked_div(width) {
            None | Some(0) => DelotetDoublesView { data: std::ptr::null(), count: 0, width: 0 },
            Some(count) => DelotetDoublesView { data: list.as_ptr(), count, width },
        }
    }
}

impl DelotetIndexRowsView {
    /// A view of rows of `K` indices.
    pub(super) fn new<const K: usize>(rows: &[[u32; K]]) -> Self {
        match rows {
            [] => DelotetIndexRowsView { data: std::ptr::null(), count: 0, width: 0 },
            _ => DelotetIndexRowsView { data: rows.as_ptr().cast(), count: rows.len(), width: K },
        }
    }
}

impl DelotetSecondOrderView {
    /// A view of nodes and tetrahedra.
    pub(super) fn new(nodes: &[[f64; 3]], tets: &[[u32; 10]]) -> Self {
        let (points, rows) = (DelotetPointsView::new(nodes), DelotetIndexRowsView::new(tets));
        let (node_count, tet_count) = (points.count, rows.count);
        DelotetSecondOrderView { nodes: points.data, node_count, tets: rows.data, tet_count }
    }
}

/// Asserts that two types have the same size and alignment and that these fields have the same offsets.
macro_rules! same_layout {
    ($c:ty, $rust:ty, $($c_field:ident = $field:ident),*) => {
        const _: () = assert!(size_of::<$c>() == size_of::<$rust>() && align_of::<$c>() == align_of::<$rust>());
        $(const _: () = assert!(offset_of!($c, $c_field) == offset_of!($rust, $field));)*
    };
}
pub(super) use same_layout;
same_layout!(DelotetSegment, Segment, ends = ends, marker = marker);
same_layout!(DelotetSubface, Subface, corners = corners, facet = facet, marker = marker, tets = tets);
same_layout!(DelotetSubsegment, Subsegment, ends = ends, segment = segment, marker = marker);
same_layout!(
    DelotetSteinerPoint,
    SteinerPoint,
    ends = ends,
    t = t,
    segment = segment,
    exact = exact,
    third = third,
    facet = facet,
    u = u
);
same_layout!(DelotetSteinerTerm, SteinerTerm, steiner = steiner, value = value);
same_layout!(DelotetFacetFlip, FacetFlip, old_ends = old, new_ends = new, facets = facets);
same_layout!(DelotetFace, Face, corners = corners, tets = tets, subface = subface, marker = marker);
same_layout!(DelotetEdge, Edge, ends = ends, tet = tet, subsegment = subsegment, marker = marker);
