//! Facet merging: edges between nearly coplanar facets are flipped, so that fewer of them need Steiner points.
//!
//! CAD exporters triangulate planar and cylindrical faces into slivers in single precision. Hardly any two of these are exactly coplanar,
//! so each of their edges is a segment, and segments that are not Delaunay on the surface take many Steiner points. Lawson's flips (1977)
//! replace them ([`flipper`]). Rounded arithmetic decides which flips are wanted ([`wanted`]); whether one is allowed is decided exactly
//! ([`Obstacles`](crate::plc::intersect::obstacles::Obstacles)), so the surface is a valid PLC before and after every flip.
//!
//! If the caller knows which edges the Delaunay tetrahedralization of the points has, this finally steers the flips ([`steer`]): towards
//! edges that need no Steiner point, and away from new edges on which a Steiner point would leave the input's surface.
//!
//! Every edge is examined once; after that only edges at flips, edges whose flip was wanted but not allowed, and edges that the caller
//! meanwhile wants to avoid.
//!
//! Only facets given as triangles and not split by vertices are flipped, so that a flip can be expressed in terms of the input.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::plc::patch::{connect, FixedEdge};
use crate::plc::surface::Surface;
use crate::plc::Plc;
use crate::INVALID;
use flipper::{Flipper, Rule};

mod edges;
mod flipper;
pub(super) mod net;
mod steer;
#[cfg(test)]
mod tests;
mod wanted;

/// Limit of passes over all edges: a flip may become possible when one far away has made room. 4 and 16 change nothing on seven models: it
/// only bounds the work on worse ones.
const PASSES: usize = 8;

/// The information that steers flips.
pub struct Guide<'a> {
    /// Whether the Delaunay tetrahedralization of the points has an edge.
    pub is_edge: &'a mut dyn FnMut([u32; 2]) -> bool,
    /// New edges to avoid if they lie off the input's surface (smaller ends first, sorted).
    pub avoid: &'a [[u32; 2]],
    /// Whether to avoid all new edges off the input's surface.
    pub avoid_all: bool,
}

impl Guide<'_> {
    fn avoids(&self, [a, b]: [u32; 2]) -> bool {
        self.avoid_all || self.avoid.binary_search(&[a.min(b), a.max(b)]).is_ok()
    }
}

/// Merging that can be resumed when it turns out that new edges must be avoided.
pub struct Merger<'a> {
    flipper: Flipper<'a>,
    fixed: Vec<FixedEdge>,
    plc: &'a Plc,
    /// Whether flips have been steered before.
    is_steered: bool,
}

impl<'a> Merger<'a> {
    /// Prepares the merging of triangles of facets with equal markers that meet above `degrees` before and after. `fixed` are the edges
    /// that must stay.
    ///
    /// # Errors
    /// What ends the run, `OutOfMemory`.
    pub fn new(
        surface: &'a mut Surface,
        fixed: Vec<FixedEdge>,
        plc: &'a Plc,
        degrees: f64,
        control: &Control,
    ) -> Result<Merger<'a>, Error> {
        let flipper = Flipper::new(surface, &fixed, plc, degrees, control)?;
        Ok(Merger { flipper, fixed, plc, is_steered: false })
    }

    /// The surface as it is now.
    pub fn surface(&self) -> &Surface {
        self.flipper.surface
    }

    /// Whether any edge was ever flipped, even if it was flipped back.
    pub fn is_flipped(&self) -> bool {
        self.flipper.is_started()
    }

    /// Makes edges segments that are not flipped from now on.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn keep(&mut self, edges: &[[u32; 2]]) -> Result<(), Error> {
        self.fixed.try_reserve(edges.len())?;
        for &ends in edges {
            self.flipper.edges.fix(ends);
            fallible::push(&mut self.fixed, FixedEdge { ends, parent: INVALID })?;
        }
        Ok(())
    }

    /// Flips edges, or flips them back if the guide now says so, and records this in the surface; then finds its segments and patches.
    ///
    /// # Errors
    /// `Cancelled`, `OutOfMemory`, `TooLarge`.
    pub fn run(&mut self, guide: Option<&mut Guide>, control: &Control) -> Result<(), Error> {
        let flipper = &mut self.flipper;
        let again = std::mem::replace(&mut self.is_steered, guide.is_some());
        if !flipper.is_started() {
            let (avoid, avoid_all) =
                guide.as_ref().map_or((&[][..], false), |guide| (guide.avoid, guide.avoid_all));
            let mut none = Guide { is_edge: &mut |_| true, avoid, avoid_all };
            flipper.run(Rule::Angles, &mut none, PASSES, control)?;
        }
        if let Some(guide) = guide {
            if again {
                // Costs have changed only at the edges to avoid.
                for &edge in guide.avoid {
                    flipper.look_at(edge)?;
                }
                flipper.run_on(Rule::Cost, guide, PASSES, control)?;
            } else {
                flipper.run(Rule::Cost, guide, PASSES, control)?;
            }
            flipper.take_back(guide, control)?;
            flipper.run_on(Rule::Cost, guide, PASSES, control)?;
        }
        let beside = flipper.edges_beside(control)?;
        flipper.surface.edges_beside = beside;
        connect(flipper.surface, &self.fixed, |facet| self.plc.facet_marker(facet as usize), control)
    }
}
