//! Cavities: sets of tetrahedra removed from a mesh and replaced by others.
//!
//! Invariants: the faces of the boundary stay; subfaces (faces flagged on both sides) with both sides in the cavity count as boundary
//! twice, once each way; constrained edges inside are listed, so that every filling keeps them.
use crate::delaunay::Delaunay;
use crate::error::Error;
use crate::kernel::edge_key;
use crate::kernel::flag;
use crate::kernel::refill::Refill;
use crate::kernel::tables::EDGE;
use rustc_hash::FxHashSet;

/// Constrained edges that the mesh has.
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
    /// Constrained edges that no boundary face has.
    pub edges: Vec<[u32; 2]>,
    on_boundary: FxHashSet<[u32; 2]>,
    corners: FxHashSet<u32>,
    /// Replaces it in the mesh.
    pub refill: Refill,
}

impl Cavity {
    /// Removes everything.
    pub fn clear(&mut self) {
        self.tets.clear();
    }

    /// Adds a tetrahedron unless it is in; it is marked until [`Cavity::bound`].
    pub fn add(&mut self, delaunay: &mut Delaunay, t: u32) -> Result<(), Error> {
        let flags = &mut delaunay.mesh.flags[t as usize];
        if *flags & flag::MARK == 0 {
            *flags |= flag::MARK;
            self.tets.try_reserve(1)?;
            self.tets.push(t);
        }
        Ok(())
    }

    /// Marks the tetrahedra, until [`Cavity::bound`].
    pub fn mark(&self, delaunay: &mut Delaunay) {
        for &t in &self.tets {
            delaunay.mesh.flags[t as usize] |= flag::MARK;
        }
    }

    /// Removes the marks without looking further.
    pub fn unmark(&self, delaunay: &mut Delaunay) {
        for &t in &self.tets {
            delaunay.mesh.flags[t as usize] &= !flag::MARK;
        }
    }

    /// Finds the boundary, the vertices and the constrained edges inside; removes the marks.
    pub fn bound(&mut self, delaunay: &mut Delaunay, edges: &Edges) -> Result<(), Error> {
        self.faces.clear();
        self.inner.clear();
        self.edges.clear();
        self.on_boundary.clear();
        self.corners.clear();
        let mesh = &delaunay.mesh;
        for &t in &self.tets {
            for f in 0..4u32 {
                let n = mesh.adj[t as usize][f as usize] >> 2;
                let constrained = mesh.flags[t as usize] & (flag::FACE << f) != 0;
                if mesh.flags[n as usize] & flag::MARK != 0 && !constrained {
                    continue;
                }
                let [x, y, z] = mesh.face(4 * t + f);
                self.faces.try_reserve(1)?;
                self.faces.push([x, y, z]);
                self.corners.extend([x, y, z]);
                self.on_boundary.extend([edge_key(x, y), edge_key(y, z), edge_key(z, x)]);
            }
        }
        for &t in &self.tets {
            let v = mesh.verts[t as usize];
            for w in v {
                if self.corners.insert(w) {
                    self.inner.try_reserve(1)?;
                    self.inner.push(w);
                }
            }
            for [i, j] in EDGE {
                let key = edge_key(v[i as usize], v[j as usize]);
                if edges.contains(&key) && self.on_boundary.insert(key) {
                    self.edges.try_reserve(1)?;
                    self.edges.push(key);
                }
            }
        }
        self.unmark(delaunay);
        Ok(())
    }

    /// Replaces the cavity's tetrahedra by others; their slots are then in `refill.fresh`. `subfaces`: faces inside that become
    /// constrained.
    pub fn replace(
        &mut self,
        delaunay: &mut Delaunay,
        tets: &[[u32; 4]],
        subfaces: &[[u32; 3]],
    ) -> Result<(), Error> {
        let Delaunay { mesh, vertex_tet, .. } = delaunay;
        self.refill.replace(mesh, vertex_tet, &self.tets, tets, subfaces.iter().copied())
    }
}
