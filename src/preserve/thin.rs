//! Taking points inside away: the star of each is filled without it, where small polyhedron reconnection finds a way (contraction to
//! a neighbour included: that is a filling with a common apex).
use super::hollow::{Growth, Hollow, Start};
use super::inside::Inside;
use super::solid::{Sector, Solid};
use crate::error::Error;
use crate::mesh::star::StarSearch;
use crate::mesh::NONE;
use crate::predicates::Points;
use crate::reconnect::{Polyhedron, Reconnect};
use rustc_hash::FxHashSet;

/// Deletes points inside.
#[derive(Default)]
pub struct Thin {
    reconnect: Reconnect,
    search: StarSearch,
    faces: Vec<[u32; 3]>,
    hollow: Hollow,
}

impl Thin {
    /// Tries each point with the given budget until none goes any more; returns how many went.
    pub fn run(
        &mut self,
        solid: &mut Solid,
        points: &Points,
        inside: &mut Inside,
        isolated: &FxHashSet<[u32; 2]>,
        growth: Growth,
    ) -> Result<u64, Error> {
        let mut gone = 0;
        loop {
            let before = gone;
            for i in (0..inside.list.len()).rev() {
                gone += u64::from(self.delete(solid, points, inside.list[i], isolated, growth)?);
            }
            inside.sweep(solid);
            if gone == before {
                return Ok(gone);
            }
        }
    }

    /// Fills the star of `p` without it, if it can.
    fn delete(
        &mut self,
        solid: &mut Solid,
        points: &Points,
        p: u32,
        isolated: &FxHashSet<[u32; 2]>,
        growth: Growth,
    ) -> Result<bool, Error> {
        let start = solid.vertex_tet[p as usize];
        if start == NONE {
            return Ok(false);
        }
        self.search.vertex_star(&mut solid.mesh, p, start);
        self.faces.clear();
        self.faces.try_reserve(self.search.tets.len())?;
        for &t in &self.search.tets {
            if let Some(slot) = solid.mesh.slot_of(t, p) {
                self.faces.push(solid.mesh.face(4 * t + slot));
            }
        }
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
                self.hollow.grow(solid, points, &mut self.reconnect, &start, isolated, growth)?
            else {
                return Ok(false);
            };
            new = found;
            old = std::mem::take(&mut self.hollow.tets);
        }
        let region = solid.region[start as usize];
        solid.replace(&[Sector { old, new, region }])?;
        solid.vertex_tet[p as usize] = NONE;
        Ok(true)
    }
}
