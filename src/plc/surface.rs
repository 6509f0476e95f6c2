//! The PLC prepared for constrained Delaunay tetrahedralization, as [`prepare`](crate::plc::prepare::prepare) returns it.
//!
//! Invariants: the points are distinct up to `alias`; segments and triangles refer only to alias representatives; no vertex lies inside a
//! segment, a triangle or an edge of a triangle.
use crate::error::Error;
use crate::fallible;
use crate::output::FacetFlip;

/// The prepared PLC: distinct vertices, constrained edges, and a triangulation of all facets that conforms to all vertices.
#[derive(Debug, PartialEq, Default)]
pub struct Surface {
    /// All input points, scaled by `2^scale` (#points by 3).
    pub points: Vec<[f64; 3]>,
    /// The power of two that scales the input into the range of exact arithmetic; 0 for ordinary input.
    pub scale: i32,
    /// For each input point the first point equal to it (itself if there is no earlier one).
    pub alias: Vec<u32>,
    /// Every constrained edge once, smaller index first, sorted (#segments by 2).
    pub segments: Vec<[u32; 2]>,
    /// For each segment the first input segment it lies on, or [`INVALID`](crate::INVALID) for an edge only of facets.
    pub segment_parent: Vec<u32>,
    /// Segments that are diagonals, chosen during triangulation, of a polygon that is planar only up to rounding, and its facet; in
    /// ascending order.
    pub diagonals: Vec<(u32, u32)>,
    /// The first facet that is a polygon: those before it are triangles of the input.
    pub first_polygon: u32,
    /// The triangulation of all facets (#triangles by 3).
    pub triangles: Vec<[u32; 3]>,
    /// For each triangle its facet, in the numbering of the PLC.
    pub triangle_facet: Vec<u32>,
    /// For each triangle its patch: patches are maximal sets of triangles connected through flat edges.
    pub triangle_patch: Vec<u32>,
    /// The number of patches.
    pub patch_count: u32,
    /// The flips of facet merging, in order.
    pub facet_flips: Vec<FacetFlip>,
    /// Edges made by flips that lie off the input's surface by more than rounding: smaller index first, sorted.
    pub edges_beside: Vec<[u32; 2]>,
}

impl Surface {
    /// A copy.
    ///
    /// # Errors
    /// [`Status::OutOfMemory`](crate::Status::OutOfMemory).
    pub fn copied(&self) -> Result<Surface, Error> {
        Ok(Surface {
            points: fallible::copied(&self.points)?,
            scale: self.scale,
            alias: fallible::copied(&self.alias)?,
            segments: fallible::copied(&self.segments)?,
            segment_parent: fallible::copied(&self.segment_parent)?,
            diagonals: fallible::copied(&self.diagonals)?,
            first_polygon: self.first_polygon,
            triangles: fallible::copied(&self.triangles)?,
            triangle_facet: fallible::copied(&self.triangle_facet)?,
            triangle_patch: fallible::copied(&self.triangle_patch)?,
            patch_count: self.patch_count,
            facet_flips: fallible::copied(&self.facet_flips)?,
            edges_beside: fallible::copied(&self.edges_beside)?,
        })
    }
}
