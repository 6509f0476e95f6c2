//! Cavities: sets of tetrahedra taken out of a mesh and put back in another way.
//!
//! Invariants: the faces of the boundary stay; subfaces (faces flagged on both sides) with both sides in the cavity count as boundary
//! twice, once each way; constrained edges inside are listed, so that whoever fills the cavity keeps them.
use crate::constrain::{edge_key, face_key};
use crate::delaunay::Delaunay;
use crate::error::Error;
use crate::mesh::flag;
use crate::mesh::tables::EDGE;
use rustc_hash::{FxHashMap, FxHashSet};

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
    open: FxHashMap<[u32; 3], u32>,
    constrained: FxHashSet<[u32; 3]>,
}

impl Cavity {
    /// Starts anew.
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

    /// Adds the tetrahedra beyond all unconstrained boundary faces; all are marked until [`Cavity::bound`].
    pub fn grow(&mut self, delaunay: &mut Delaunay) -> Result<(), Error> {
        self.mark(delaunay);
        for i in 0..self.tets.len() {
            let t = self.tets[i] as usize;
            for f in 0..4 {
                let n = delaunay.mesh.adj[t][f] >> 2;
                if delaunay.mesh.flags[t] & (flag::FACE << f) == 0 && !delaunay.mesh.is_ghost(n) {
                    self.add(delaunay, n)?;
                }
            }
        }
        Ok(())
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

    /// Puts other tetrahedra in the place of the cavity's. `subfaces`: faces inside that become constrained.
    pub fn replace(
        &mut self,
        delaunay: &mut Delaunay,
        tets: &[[u32; 4]],
        subfaces: &[[u32; 3]],
    ) -> Result<(), Error> {
        let Cavity { open, constrained, .. } = self;
        open.clear();
        constrained.clear();
        let mesh = &mut delaunay.mesh;
        mesh.reserve(tets.len())?;
        for &t in &self.tets {
            mesh.flags[t as usize] |= flag::MARK;
        }
        for &t in &self.tets {
            for f in 0..4u32 {
                let key = face_key(mesh.face(4 * t + f));
                if mesh.flags[t as usize] & (flag::FACE << f) != 0 {
                    constrained.insert(key);
                }
                let n = mesh.adj[t as usize][f as usize];
                if mesh.flags[(n >> 2) as usize] & flag::MARK == 0 {
                    open.insert(key, n);
                }
            }
        }
        constrained.extend(subfaces.iter().map(|&s| face_key(s)));
        for &t in &self.tets {
            mesh.release(t);
        }
        for v in tets {
            let t = mesh.allocate(*v);
            for w in v {
                delaunay.vertex_tet[*w as usize] = t;
            }
            for f in 0..4u32 {
                let code = 4 * t + f;
                let key = face_key(mesh.face(code));
                if constrained.contains(&key) {
                    mesh.flags[t as usize] |= flag::FACE << f;
                }
                match open.remove(&key) {
                    Some(other) => mesh.link(code, other),
                    None => {
                        open.insert(key, code);
                    }
                }
            }
        }
        if !open.is_empty() {
            return Err(Error::internal("the filling of a cavity does not fit its boundary"));
        }
        // A subface that became constrained is flagged on the outer side as well: it may lie on the cavity's boundary.
        Ok(())
    }
}
