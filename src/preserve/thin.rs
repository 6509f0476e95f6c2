//! Taking points inside away: the star of each is filled without it, where small polyhedron reconnection finds a way (contraction to
//! a neighbour included: that is a filling with a common apex).
use super::inside::Inside;
use super::solid::{Sector, Solid};
use crate::error::Error;
use crate::mesh::star::StarSearch;
use crate::mesh::NONE;
use crate::predicates::Points;
use crate::reconnect::{Polyhedron, Reconnect};

/// Deletes points inside.
#[derive(Default)]
pub struct Thin {
    reconnect: Reconnect,
    search: StarSearch,
    faces: Vec<[u32; 3]>,
}

impl Thin {
    /// Tries each point with the given budget until none goes any more; returns how many went.
    pub fn run(
        &mut self,
        solid: &mut Solid,
        points: &Points,
        inside: &mut Inside,
        budget: u32,
    ) -> Result<u64, Error> {
        let mut gone = 0;
        loop {
            let before = gone;
            for i in (0..inside.list.len()).rev() {
                gone += u64::from(self.delete(solid, points, inside.list[i], budget)?);
            }
            inside.sweep(solid);
            if gone == before {
                return Ok(gone);
            }
        }
    }

    /// Fills the star of `p` without it, if it can.
    fn delete(&mut self, solid: &mut Solid, points: &Points, p: u32, budget: u32) -> Result<bool, Error> {
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
        if !self.reconnect.fill(points, &polyhedron, budget, &mut new)? {
            return Ok(false);
        }
        let region = solid.region[start as usize];
        solid.replace(&[Sector { old: self.search.tets.clone(), new, region }])?;
        solid.vertex_tet[p as usize] = NONE;
        Ok(true)
    }
}
