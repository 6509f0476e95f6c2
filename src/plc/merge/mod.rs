//! Facet merging: edges between almost coplanar facets are flipped, so that fewer of them need Steiner points.
//!
//! CAD exporters triangulate planar and cylindrical faces into slivers in single precision. Hardly any two are exactly coplanar, so
//! each of their edges is a segment, and segments that are not Delaunay on the surface take many Steiner points. Lawson's
//! flips (1977) replace them ([`flipper`]). Which flips are wanted is a matter of rounded arithmetic ([`wanted`]); whether one is
//! allowed is decided exactly ([`Obstacles`](super::intersect::obstacles::Obstacles)), so the surface is a valid PLC before
//! and after every flip.
//!
//! Where the caller can tell which edges the Delaunay tetrahedralization of the points has, flips are steered by that in the end
//! ([`steer`]): towards edges that need no Steiner point, and away from new edges on which a Steiner point would
//! leave the input's surface.
//!
//! Only facets given as triangles, and not split by vertices in them, take part: a flip can be told in terms of the input then.
use super::patch::FixedEdge;
use super::surface::Surface;
use super::Plc;
use crate::error::Error;
use crate::progress::Observer;
use flipper::{Flipper, Rule};

mod edges;
mod flipper;
mod steer;
#[cfg(test)]
mod tests;
mod wanted;

/// What steers flips.
pub struct Guide<'a> {
    /// Tells whether the Delaunay tetrahedralization of the points has an edge.
    pub is_edge: &'a mut dyn FnMut([u32; 2]) -> bool,
    /// New edges that are to be avoided if they lie beside the input's surface (smaller ends first, sorted).
    pub avoid: &'a [[u32; 2]],
    /// All new edges beside the input's surface are to be avoided.
    pub avoid_all: bool,
}

impl Guide<'_> {
    fn avoids(&self, [a, b]: [u32; 2]) -> bool {
        self.avoid_all || self.avoid.binary_search(&[a.min(b), a.max(b)]).is_ok()
    }
}

/// Passes over all edges at most: a flip may become possible when another one far away has made room.
const PASSES: usize = 8;

/// Flips the edges between triangles of facets with equal markers that meet above `degrees` before and after, and records the flips
/// in the surface. `fixed` are the edges that must stay.
///
/// # Errors
/// `Cancelled`, `OutOfMemory`.
pub fn merge(
    surface: &mut Surface,
    fixed: &[FixedEdge],
    plc: &Plc,
    degrees: f64,
    guide: Option<&mut Guide>,
    observer: &mut dyn Observer,
) -> Result<(), Error> {
    let mut flipper = Flipper::new(surface, fixed, plc, degrees)?;
    let mut none = Guide { is_edge: &mut |_| true, avoid: &[], avoid_all: false };
    flipper.run(Rule::Angles, &mut none, PASSES, observer)?;
    if let Some(guide) = guide {
        flipper.run(Rule::Cost, guide, PASSES, observer)?;
        flipper.take_back(guide, observer)?;
        flipper.run(Rule::Cost, guide, PASSES, observer)?;
    }
    let beside = flipper.edges_beside()?;
    surface.edges_beside = beside;
    Ok(())
}
