//! The cavity: a set of tetrahedra that go, what bounds it, and what inside it must stay.
//!
//! Invariants: the faces of the boundary stay; subfaces with both sides in the cavity count as boundary twice, once each way; edges inside
//! that must stay are listed, so that every filling keeps them.
use crate::error::Error;
use crate::kernel::tables::EDGE;
use crate::kernel::visited::Visited;
use crate::kernel::{edge_key, Mesh};
use rustc_hash::FxHashSet;

/// Edges that must stay.
pub type Edges = FxHashSet<[u32; 2]>;

/// A set of tetrahedra and what bounds it.
#[derive(Default)]
pub struct Cavity {
    /// The tetrahedra, without repetition.
    pub tets: Vec<u32>,
    /// Boundary triangles `(x, y, z)` such that `(p, x, y, z)` is positive for `p` inside.
    pub faces: Vec<[u32; 3]>,
    /// Vertices that no boundary face has.
    pub inner: Vec<u32>,
    /// Edges that must stay and that no boundary face has.
    pub edges: Vec<[u32; 2]>,
    visited: Visited,
    on_boundary: FxHashSet<[u32; 2]>,
    corners: FxHashSet<u32>,
}

impl Cavity {
    /// Removes everything.
    pub fn clear(&mut self) {
        self.tets.clear();
        self.visited.begin();
    }

    /// Adds a tetrahedron unless it is in.
    pub fn add(&mut self, t: u32) -> Result<(), Error> {
        if self.visited.insert(t)? {
            self.tets.try_reserve(1)?;
            self.tets.push(t);
        }
        Ok(())
    }

    /// Finds the boundary, the vertices and those of the given edges that are inside, for the tetrahedra in `tets`.
    pub fn bound(&mut self, mesh: &Mesh, edges: &Edges) -> Result<(), Error> {
        self.faces.clear();
        self.inner.clear();
        self.edges.clear();
        self.on_boundary.clear();
        self.corners.clear();
        self.visited.begin();
        for &t in &self.tets {
            self.visited.insert(t)?;
        }
        for &t in &self.tets {
            for code in 4 * t..4 * t + 4 {
                if self.visited.contains(mesh.across(code) >> 2) && !mesh.is_subface(code) {
                    continue;
                }
                let [x, y, z] = mesh.face(code);
                self.faces.try_reserve(1)?;
                self.corners.try_reserve(3)?;
                self.on_boundary.try_reserve(3)?;
                self.faces.push([x, y, z]);
                self.corners.extend([x, y, z]);
                self.on_boundary.extend([edge_key(x, y), edge_key(y, z), edge_key(z, x)]);
            }
        }
        for &t in &self.tets {
            let v = mesh.verts(t);
            self.corners.try_reserve(4)?;
            self.inner.try_reserve(4)?;
            self.inner.extend(v.into_iter().filter(|&w| self.corners.insert(w)));
            for [i, j] in EDGE {
                let key = edge_key(v[i as usize], v[j as usize]);
                if edges.contains(&key) && self.on_boundary.insert(key) {
                    self.edges.try_reserve(1)?;
                    self.edges.push(key);
                }
            }
        }
        Ok(())
    }
}
