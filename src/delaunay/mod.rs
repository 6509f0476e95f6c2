//! Delaunay tetrahedralization by incremental insertion (Bowyer 1981, Watson 1981) over ghost tetrahedra.
//!
//! Ties are broken by one symbolic perturbation of the lifting by vertex id (engine notes §4): the perturbed Delaunay
//! tetrahedralization is unique, has no flat tetrahedron, and does not depend on the insertion order.
//!
//! Invariant between insertions: `mesh` is the perturbed Delaunay tetrahedralization of the inserted vertices, closed by
//! ghosts.
pub mod cavity;
pub mod check;
mod edge_table;
pub mod locate;
pub mod order;

use crate::error::{Error, Status};
use crate::mesh::{Tetrahedra, GHOST, NONE};
use crate::predicates::{Points, Sign};
use cavity::Cavity;

/// A Delaunay tetrahedralization under construction.
#[derive(Clone, Default)]
pub struct Delaunay {
    /// The tetrahedra.
    pub mesh: Tetrahedra,
    /// One live tetrahedron of each vertex, kept by constrained insertion; see [`Delaunay::index_vertices`].
    pub vertex_tet: Vec<u32>,
    /// Where the next walk starts.
    pub hint: u32,
    /// Scratch space of insertions.
    pub cavity: Cavity,
}

impl Delaunay {
    /// An empty triangulation.
    pub fn new() -> Self {
        Self::default()
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        self.mesh.bytes() + self.vertex_tet.capacity() * 4 + self.cavity.bytes()
    }

    /// Starts with the first four vertices of `order` that are not coplanar and moves them to its front.
    pub fn start(&mut self, points: &Points, order: &mut [u32]) -> Result<(), Error> {
        self.mesh.clear();
        let flat = || Error::new(Status::DegenerateInput, "all points lie in one plane");
        if order.len() < 4 {
            return Err(flat());
        }
        let third =
            (2..order.len()).find(|&i| !points.collinear(order[0], order[1], order[i])).ok_or_else(flat)?;
        order[2..=third].rotate_right(1);
        let [a, b, c] = [order[0], order[1], order[2]];
        let fourth =
            (3..order.len()).find(|&i| points.orient3d(a, b, c, order[i]) != Sign::Zero).ok_or_else(flat)?;
        order[3..=fourth].rotate_right(1);
        let d = order[3];
        let v = if points.orient3d(a, b, c, d) == Sign::Positive { [a, b, c, d] } else { [a, c, b, d] };
        self.mesh.reserve(5)?;
        let t = self.mesh.allocate(v);
        let mut ghosts = [0; 4];
        for f in 0..4 {
            // (apex, x, y, z) is positive, so (x, y, z, p) is for p beyond the face.
            let [x, y, z] = self.mesh.face(4 * t + f);
            let g = self.mesh.allocate([x, y, z, GHOST]);
            ghosts[f as usize] = g;
            self.mesh.link(4 * t + f, 4 * g + 3);
        }
        for i in 0..4 {
            for j in 0..i {
                self.link_ghosts(ghosts[i], ghosts[j]);
            }
        }
        self.hint = t;
        Ok(())
    }

    /// Makes two ghosts neighbours across the face of their common hull edge.
    fn link_ghosts(&mut self, g: u32, h: u32) {
        let (a, b) = (self.mesh.verts[g as usize], self.mesh.verts[h as usize]);
        let f = (0..3).find(|&i| !b.contains(&a[i])).unwrap_or(0) as u32;
        let k = (0..3).find(|&i| !a.contains(&b[i])).unwrap_or(0) as u32;
        self.mesh.link(4 * g + f, 4 * h + k);
    }

    /// Inserts one vertex, which equals none of the present ones.
    pub fn insert(&mut self, points: &Points, p: u32) -> Result<(), Error> {
        let t = self.locate(points, p, self.hint)?;
        self.hint = self.insert_at::<false>(points, p, t)?;
        Ok(())
    }

    /// Builds the triangulation of the given vertices, in this order of insertion (the first four may change places with
    /// later ones). `tick` is called now and then with the number of vertices done.
    pub fn build(
        &mut self,
        points: &Points,
        order: &mut [u32],
        tick: &mut dyn FnMut(usize) -> Result<(), Error>,
    ) -> Result<(), Error> {
        self.cavity.prepare(points.len())?;
        self.start(points, order)?;
        for (i, &p) in order.iter().enumerate().skip(4) {
            if i % 8192 == 0 {
                tick(i)?;
            }
            self.insert(points, p)?;
        }
        Ok(())
    }

    /// Fills `vertex_tet` for `vertex_count` vertices: a finite tetrahedron where there is one, NONE for absent vertices.
    pub fn index_vertices(&mut self, vertex_count: usize) -> Result<(), Error> {
        self.vertex_tet.clear();
        self.vertex_tet.try_reserve(vertex_count)?;
        self.vertex_tet.resize(vertex_count, NONE);
        for t in 0..self.mesh.slot_count() {
            if self.mesh.is_live(t as u32) && !self.mesh.is_ghost(t as u32) {
                for v in self.mesh.verts[t] {
                    self.vertex_tet[v as usize] = t as u32;
                }
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
