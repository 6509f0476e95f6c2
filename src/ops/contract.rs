//! Contraction: two neighbours inside become one vertex at a better position, or none if the union of their stars can be filled without.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::kernel::around::StarSearch;
use crate::kernel::replace::Replace;
use crate::kernel::{Mesh, NONE};
use crate::ops::place::place_at_center;
use crate::ops::reconnect::{Polyhedron, Reconnect};
use crate::predicates::Points;

/// Contracts edges; keeps its scratch space.
pub struct Contract<'a> {
    reconnect: Reconnect<'a>,
    search: StarSearch,
    replace: Replace,
    faces: Vec<[u32; 3]>,
    /// The tetrahedra that the last attempt has read, with repetitions: while they stay, it would end the same way.
    pub read: Vec<u32>,
}

impl<'a> Contract<'a> {
    /// Searches that this control may end.
    pub fn new(control: &'a Control<'a>) -> Self {
        Contract {
            reconnect: Reconnect::new(control),
            search: StarSearch::default(),
            replace: Replace::default(),
            faces: Vec::new(),
            read: Vec::new(),
        }
    }

    /// Removes `p` together with a neighbour that is also movable, by a filling without both, or replaces both by `p` at another position.
    pub fn merge(
        &mut self,
        mesh: &mut Mesh,
        points: &mut Points,
        movable: &[u32],
        p: u32,
        budget: u32,
    ) -> Result<bool, Error> {
        self.read.clear();
        let start = mesh.vertex_tet[p as usize];
        if start == NONE {
            return Ok(false);
        }
        self.search.vertex_star(mesh, p, start)?;
        fallible::append(&mut self.read, &self.search.tets)?;
        let mut others = fallible::collect(self.search.tets.iter().flat_map(|&t| mesh.verts(t)))?;
        others.sort_unstable();
        others.dedup();
        others.retain(|q| *q != p && movable.contains(q));
        let star = fallible::copied(&self.search.tets)?;
        for q in others {
            self.search.vertex_star(mesh, q, mesh.vertex_tet[q as usize])?;
            fallible::append(&mut self.read, &self.search.tets)?;
            let mut old = fallible::copied(&star)?;
            fallible::append(&mut old, &self.search.tets)?;
            old.sort_unstable();
            old.dedup();
            self.faces.clear();
            for code in old.iter().flat_map(|&t| 4 * t..4 * t + 4) {
                let face = mesh.face(code);
                if !face.contains(&p) && !face.contains(&q) {
                    fallible::push(&mut self.faces, face)?;
                }
            }
            let mut new = Vec::new();
            let polyhedron = Polyhedron { faces: &self.faces, ..Polyhedron::default() };
            if self.reconnect.fill(points, &polyhedron, budget, &mut new)? {
                self.replace.cavity(mesh, &old, &new, &[])?;
                mesh.vertex_tet[p as usize] = NONE;
                mesh.vertex_tet[q as usize] = NONE;
                return Ok(true);
            }
            let at = *points.xyz(p);
            if place_at_center(points, p, &self.faces)? {
                fallible::extend(&mut new, self.faces.iter().map(|&[x, y, z]| [p, x, y, z]))?;
                self.replace.cavity(mesh, &old, &new, &[])?;
                mesh.vertex_tet[q as usize] = NONE;
                return Ok(true);
            }
            points.move_to(p, at)?;
        }
        Ok(false)
    }
}
