//! Removal of points inside: the star of each is filled without it, if small polyhedron reconnection finds a filling (this includes
//! contraction to a neighbour, which is a filling with a common apex).
use crate::error::Error;
use crate::kernel::around::StarSearch;
use crate::kernel::replace::Replace;
use crate::kernel::Mesh;
use crate::kernel::NONE;
use crate::ops::place::place_at_center;
use crate::ops::reconnect::{Polyhedron, Reconnect};
use crate::predicates::Points;
use crate::preserve::inside::Inside;
use crate::preserve::memory::Memory;
use crate::preserve::release::hollow::{Growth, Hollow, Start};
use rustc_hash::FxHashSet;

/// Deletes points inside.
#[derive(Default)]
pub struct Thin {
    reconnect: Reconnect,
    search: StarSearch,
    replace: Replace,
    faces: Vec<[u32; 3]>,
    hollow: Hollow,
    /// The tetrahedra that the current attempt has read.
    read: Vec<u32>,
}

impl Thin {
    /// Tries to remove each point with the given budget until none can be removed; returns the number removed.
    pub fn run(
        &mut self,
        mesh: &mut Mesh,
        points: &mut Points,
        inside: &mut Inside,
        isolated: &FxHashSet<[u32; 2]>,
        growth: Growth,
        tick: &mut dyn FnMut() -> Result<(), Error>,
    ) -> Result<u64, Error> {
        let (mut lasting, mut unmerged) = (Memory::default(), Memory::default());
        let mut gone = 0;
        loop {
            let before = gone;
            for i in (0..inside.list.len()).rev() {
                tick()?;
                let p = inside.list[i];
                if lasting.knows(mesh, p) {
                    continue;
                }
                if self.delete(mesh, points, p, isolated, growth)? {
                    gone += 1;
                } else {
                    lasting.note(mesh, p, &self.read)?;
                }
            }
            inside.sweep(mesh);
            for i in (0..inside.list.len()).rev() {
                tick()?;
                let p = inside.list[i];
                if unmerged.knows(mesh, p) {
                    continue;
                }
                if self.merge(mesh, points, inside, p, growth.budget)? {
                    gone += 1;
                } else {
                    unmerged.note(mesh, p, &self.read)?;
                }
            }
            inside.sweep(mesh);
            if gone == before {
                return Ok(gone);
            }
        }
    }

    /// Fills the star of `p` without it, if it can.
    fn delete(
        &mut self,
        mesh: &mut Mesh,
        points: &Points,
        p: u32,
        isolated: &FxHashSet<[u32; 2]>,
        growth: Growth,
    ) -> Result<bool, Error> {
        self.read.clear();
        let start = mesh.vertex_tet[p as usize];
        if start == NONE {
            return Ok(false);
        }
        self.search.link(mesh, p, &mut self.faces)?;
        self.read.try_reserve(self.search.tets.len())?;
        self.read.extend_from_slice(&self.search.tets);
        let mut new = Vec::new();
        let polyhedron = Polyhedron { faces: &self.faces, inner: &[], ..Polyhedron::default() };
        let mut old = self.search.tets.clone();
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
            let Some(found) =
                self.hollow.grow(mesh, points, &mut self.reconnect, &start, isolated, growth)?
            else {
                self.read.try_reserve(self.hollow.read.len())?;
                self.read.extend_from_slice(&self.hollow.read);
                return Ok(false);
            };
            new = found;
            old = std::mem::take(&mut self.hollow.cavity.tets);
        }
        self.replace.cavity(mesh, &old, &new, &[])?;
        mesh.vertex_tet[p as usize] = NONE;
        Ok(true)
    }

    /// Removes `p` together with a neighbour that is also a point inside, by a filling without both, or replaces both by `p` at another
    /// position.
    fn merge(
        &mut self,
        mesh: &mut Mesh,
        points: &mut Points,
        inside: &Inside,
        p: u32,
        budget: u32,
    ) -> Result<bool, Error> {
        self.read.clear();
        let start = mesh.vertex_tet[p as usize];
        if start == NONE {
            return Ok(false);
        }
        self.search.vertex_star(mesh, p, start)?;
        self.read.try_reserve(self.search.tets.len())?;
        self.read.extend_from_slice(&self.search.tets);
        let mut others: Vec<u32> = self.search.tets.iter().flat_map(|&t| mesh.verts(t)).collect();
        others.sort_unstable();
        others.dedup();
        others.retain(|q| *q != p && inside.list.contains(q));
        let star = self.search.tets.clone();
        for q in others {
            self.search.vertex_star(mesh, q, mesh.vertex_tet[q as usize])?;
            self.read.try_reserve(self.search.tets.len())?;
            self.read.extend_from_slice(&self.search.tets);
            let mut old = star.clone();
            old.extend_from_slice(&self.search.tets);
            old.sort_unstable();
            old.dedup();
            self.faces.clear();
            for code in old.iter().flat_map(|&t| 4 * t..4 * t + 4) {
                let face = mesh.face(code);
                if !face.contains(&p) && !face.contains(&q) {
                    self.faces.push(face);
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
                new.extend(self.faces.iter().map(|&[x, y, z]| [p, x, y, z]));
                self.replace.cavity(mesh, &old, &new, &[])?;
                mesh.vertex_tet[q as usize] = NONE;
                return Ok(true);
            }
            points.move_to(p, at)?;
        }
        Ok(false)
    }
}
