//! Small polyhedron reconnection: a search for a tetrahedralization of a polyhedron without additional points.
//!
//! After Liu, Chen & Chen 2007 (boundary recovery by small polyhedron reconnection) and Marot, Verhetsel & Remacle 2020
//! (branch and bound over the faces that are still open). The state is the *front*: the oriented faces that still lack
//! a tetrahedron on their inner side. A step takes the front face with the fewest possible apexes and joins it to one; the faces
//! of the new tetrahedron close front faces or become new ones. An empty front is a solution.
//!
//! Why a solution is valid: all its tetrahedra are positive, and their boundaries add up, face by face, to the boundary of the polyhedron.
//! So every point on no face is covered as many times as the boundary winds around it: once inside, never outside. Only orientations
//! decide; all other tests (crossings, contained vertices) prune the search. They use exact signs too, from one table: a polyhedron of 20
//! vertices has 4,845 of them and needs each many times.
//!
//! The search is deterministic and bounded by a number of steps, never by time.
mod face;
mod free;
mod optimise;
mod qualities;
mod rows;
mod search;
mod signs;

use crate::control::Control;
use crate::error::Error;
use crate::ops::shape::Goal;
use crate::predicates::Points;
use search::{Budget, Search};

/// The most vertices of a polyhedron: sets of vertices are bits of one word. A limit of 32 changes nothing on eleven models: it only bounds
/// the work on worse ones.
pub const MOST_VERTICES: usize = 64;

/// The polyhedron to be filled.
#[derive(Clone, Copy, Debug, Default)]
pub struct Polyhedron<'a> {
    /// Boundary triangles `(x, y, z)` such that `(p, x, y, z)` is positive for `p` inside.
    pub faces: &'a [[u32; 3]],
    /// Vertices inside, on no boundary face. Each becomes a vertex of a tetrahedron.
    pub inner: &'a [u32],
    /// Pairs of vertices that must be edges.
    pub edges: &'a [[u32; 2]],
}

/// Fills polyhedra; keeps its scratch space.
pub struct Reconnect<'a> {
    search: Search,
    control: &'a Control<'a>,
}

impl<'a> Reconnect<'a> {
    /// Searches that this control may end.
    pub fn new(control: &'a Control<'a>) -> Self {
        Reconnect { search: Search::default(), control }
    }

    /// Appends the tetrahedra of a filling to `tets` and returns true. Appends nothing and returns false if there is none, none was found
    /// within `budget` steps, or there are more than [`MOST_VERTICES`] vertices.
    pub fn fill(
        &mut self,
        points: &Points,
        polyhedron: &Polyhedron,
        budget: u32,
        tets: &mut Vec<[u32; 4]>,
    ) -> Result<bool, Error> {
        self.forget();
        self.fill_another(points, polyhedron, budget, tets)
    }

    /// The number of steps of the last search.
    pub fn steps(&self) -> u32 {
        self.search.steps
    }

    /// Forgets all vertices.
    pub fn forget(&mut self) {
        self.search.forget();
    }

    /// Like [`Reconnect::fill`], for one of several polyhedra that share many vertices: signs already computed are reused. So no vertex may
    /// have moved since the last [`Reconnect::fill`] or [`Reconnect::forget`].
    pub fn fill_another(
        &mut self,
        points: &Points,
        polyhedron: &Polyhedron,
        budget: u32,
        tets: &mut Vec<[u32; 4]>,
    ) -> Result<bool, Error> {
        if !self.search.begin(points, polyhedron)? {
            return Ok(false);
        }
        if let Some(apex) = self.search.cone(points) {
            return self.search.append_cone(apex, tets);
        }
        self.search.run(points, Budget { steps: budget, control: self.control }, tets)
    }

    /// Like [`Reconnect::fill`], but the tetrahedra must reach a goal; takes the best filling found within the budget.
    pub fn improve(
        &mut self,
        points: &Points,
        polyhedron: &Polyhedron,
        goal: Goal,
        budget: u32,
        tets: &mut Vec<[u32; 4]>,
    ) -> Result<bool, Error> {
        self.optimise(points, polyhedron, goal, false, budget, tets)
    }

    /// Like [`Reconnect::improve`], but takes the first filling found that reaches the goal.
    pub fn reach(
        &mut self,
        points: &Points,
        polyhedron: &Polyhedron,
        goal: Goal,
        budget: u32,
        tets: &mut Vec<[u32; 4]>,
    ) -> Result<bool, Error> {
        self.optimise(points, polyhedron, goal, true, budget, tets)
    }

    /// The best filling that reaches a goal, or the first.
    fn optimise(
        &mut self,
        points: &Points,
        polyhedron: &Polyhedron,
        goal: Goal,
        first: bool,
        budget: u32,
        tets: &mut Vec<[u32; 4]>,
    ) -> Result<bool, Error> {
        self.forget();
        if !self.search.begin(points, polyhedron)? {
            return Ok(false);
        }
        self.search.optimise(points, goal, first, Budget { steps: budget, control: self.control }, tets)
    }
}

#[cfg(test)]
mod tests;
