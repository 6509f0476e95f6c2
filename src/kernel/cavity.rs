//! The cavity: a set of tetrahedra that go, what bounds it, and what inside it must stay.
//!
//! Invariants: the faces of the boundary stay; subfaces with both sides in the cavity count as boundary twice, once each way; edges inside
//! that must stay are listed, so that every filling keeps them.
use crate::error::Error;
use crate::fallible;
use crate::kernel::tables::EDGE;
use crate::kernel::visited::Visited;
use crate::kernel::{edge_key, face_key, Mesh, NONE};
use rustc_hash::FxHashSet;

/// Edges that must stay.
pub type Edges = FxHashSet<[u32; 2]>;

/// What becomes of the walls and vertices of a cavity.
#[derive(Clone, Copy)]
pub struct Terms<'a> {
    /// Edges that must stay.
    pub keep: &'a Edges,
    /// Walls that go, as keys.
    pub gone: &'a [[u32; 3]],
    /// Walls that come, turned inward.
    pub walls: &'a [[u32; 3]],
    /// A vertex that goes, or `NONE`.
    pub without: u32,
}

impl<'a> Terms<'a> {
    /// All walls and vertices stay, and these edges.
    pub fn keep(edges: &'a Edges) -> Self {
        Terms { keep: edges, gone: &[], walls: &[], without: NONE }
    }
}

/// A set of tetrahedra and what bounds it.
#[derive(Default)]
pub struct Cavity {
    /// The tetrahedra, without repetition.
    pub tets: Vec<u32>,
    /// Boundary triangles `(x, y, z)` such that `(p, x, y, z)` is positive for `p` inside; walls that come are the last.
    pub faces: Vec<[u32; 3]>,
    /// Vertices that no boundary face has.
    pub inner: Vec<u32>,
    /// Edges that must stay and that no boundary face has.
    pub edges: Vec<[u32; 2]>,
    /// Boundary faces that are no walls: their index, and the corner code beyond.
    pub doors: Vec<(u32, u32)>,
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

    /// Removes everything, then adds these tetrahedra.
    pub fn set(&mut self, tets: &[u32]) -> Result<(), Error> {
        self.clear();
        tets.iter().try_for_each(|&t| self.add(t))
    }

    /// Adds a tetrahedron unless it is in.
    pub fn add(&mut self, t: u32) -> Result<(), Error> {
        if self.visited.insert(t)? {
            fallible::push(&mut self.tets, t)?;
        }
        Ok(())
    }

    /// Whether a tetrahedron is in.
    pub fn has(&self, t: u32) -> bool {
        self.visited.contains(t)
    }

    /// The set of tetrahedra.
    pub fn visited(&self) -> &Visited {
        &self.visited
    }

    /// The number of vertices on the boundary and inside, once it is bounded.
    pub fn vertex_count(&self) -> usize {
        self.corners.len()
    }

    /// Finds the boundary, and the vertices and edges inside.
    pub fn bound(&mut self, mesh: &Mesh, terms: &Terms) -> Result<(), Error> {
        self.find_faces(mesh, terms)?;
        self.corners.clear();
        self.corners.try_reserve(self.faces.len())?;
        fallible::add_all(&mut self.corners, self.faces.iter().flatten().copied())?;
        self.inner.clear();
        for &t in &self.tets {
            for v in mesh.verts(t) {
                if v != terms.without && fallible::add(&mut self.corners, v)? {
                    fallible::push(&mut self.inner, v)?;
                }
            }
        }
        self.find_edges(mesh, terms)
    }

    fn find_faces(&mut self, mesh: &Mesh, terms: &Terms) -> Result<(), Error> {
        self.faces.clear();
        self.doors.clear();
        for code in self.tets.iter().flat_map(|&t| 4 * t..4 * t + 4) {
            let wall = mesh.is_wall(code);
            if !wall && self.visited.contains(mesh.across(code) >> 2) {
                continue;
            }
            let face = mesh.face(code);
            if wall && !terms.gone.is_empty() && terms.gone.contains(&face_key(face)) {
                continue;
            }
            if !wall {
                fallible::push(&mut self.doors, (self.faces.len() as u32, mesh.across(code)))?;
            }
            fallible::push(&mut self.faces, face)?;
        }
        fallible::append(&mut self.faces, terms.walls)?;
        Ok(())
    }

    fn find_edges(&mut self, mesh: &Mesh, terms: &Terms) -> Result<(), Error> {
        self.edges.clear();
        if terms.keep.is_empty() {
            return Ok(());
        }
        self.on_boundary.clear();
        self.on_boundary.try_reserve(3 * self.faces.len())?;
        let sides = |&[x, y, z]: &[u32; 3]| [edge_key(x, y), edge_key(y, z), edge_key(z, x)];
        fallible::add_all(&mut self.on_boundary, self.faces.iter().flat_map(sides))?;
        for &t in &self.tets {
            let v = mesh.verts(t);
            for [i, j] in EDGE {
                let key = edge_key(v[i as usize], v[j as usize]);
                let stays = terms.keep.contains(&key) && !key.contains(&terms.without);
                if stays && fallible::add(&mut self.on_boundary, key)? {
                    fallible::push(&mut self.edges, key)?;
                }
            }
        }
        Ok(())
    }
}
