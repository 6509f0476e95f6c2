//! Removal of a vertex inside: its star is filled without it, if small polyhedron reconnection finds a filling (this includes contraction
//! to a neighbour, which is a filling with a common apex), or else a larger cavity is ([`hollow`](crate::ops::hollow)).
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::kernel::around::StarSearch;
use crate::kernel::cavity::Edges;
use crate::kernel::replace::Replace;
use crate::kernel::{Mesh, NONE};
use crate::ops::hollow::{Growth, Hollow, Start};
use crate::ops::reconnect::{Polyhedron, Reconnect};
use crate::predicates::Points;

/// Removes vertices; keeps its scratch space.
pub struct RemoveVertex<'a> {
    reconnect: Reconnect<'a>,
    search: StarSearch,
    replace: Replace,
    faces: Vec<[u32; 3]>,
    hollow: Hollow,
    /// The tetrahedra that the last attempt has read, with repetitions: while they stay, it would end the same way.
    pub read: Vec<u32>,
}

impl<'a> RemoveVertex<'a> {
    /// Searches that this control may end.
    pub fn new(control: &'a Control<'a>) -> Self {
        RemoveVertex {
            reconnect: Reconnect::new(control),
            search: StarSearch::default(),
            replace: Replace::default(),
            faces: Vec::new(),
            hollow: Hollow::default(),
            read: Vec::new(),
        }
    }

    /// Fills the star of `p` without it, if it can; the edges `keep` stay.
    pub fn remove(
        &mut self,
        mesh: &mut Mesh,
        points: &Points,
        p: u32,
        keep: &Edges,
        growth: Growth,
    ) -> Result<bool, Error> {
        self.read.clear();
        let start = mesh.vertex_tet[p as usize];
        if start == NONE {
            return Ok(false);
        }
        self.search.link(mesh, p, &mut self.faces)?;
        fallible::append(&mut self.read, &self.search.tets)?;
        let mut new = Vec::new();
        let polyhedron = Polyhedron { faces: &self.faces, inner: &[], ..Polyhedron::default() };
        let mut old = fallible::copied(&self.search.tets)?;
        if !self.reconnect.fill(points, &polyhedron, growth.budget, &mut new)? {
            if growth.tries == 0 {
                return Ok(false);
            }
            let start = Start {
                tets: &old,
                gone: &[],
                walls: &[],
                without: p,
                edge: None,
                avoid: [p; 2],
                taken: &[],
            };
            let Some(found) = self.hollow.grow(mesh, points, &mut self.reconnect, &start, keep, growth)?
            else {
                fallible::append(&mut self.read, &self.hollow.read)?;
                return Ok(false);
            };
            new = found;
            old = std::mem::take(&mut self.hollow.cavity.tets);
        }
        self.replace.cavity(mesh, &old, &new, &[])?;
        mesh.vertex_tet[p as usize] = NONE;
        Ok(true)
    }
}
