//! Cavity insertion with adjacency in O(1) per face.
//!
//! The conflict region of a vertex is collected breadth-first, its boundary faces are joined to the vertex, and the new
//! tetrahedra are linked through a table indexed by *local* vertex numbers: the boundary's vertices are renumbered from 0, and
//! the half-edge `i → j` of each boundary face is stored at `32·i + j` (the device of Marot, Pellerin & Remacle 2019).
//! Cavities with more than 32 vertices pair their half-edges by sorting.
//!
//! With `CONSTRAINED` the subsegment flags of tetrahedra are carried over: a flagged edge either lies on the boundary of
//! the cavity, where new tetrahedra inherit the flag, or is lost and reported in `lost_edges`.
use super::Delaunay;
use crate::error::Error;
use crate::mesh::tables::{EDGE, EDGE_OF, FACE};
use crate::mesh::{flag, GHOST, NONE};
use crate::predicates::{Points, Sign};

/// Boundary vertices that the table can number.
const LOCAL: usize = 32;

/// Scratch space of an insertion.
#[derive(Clone, Default)]
pub struct Cavity {
    /// Tetrahedra in conflict.
    pub dead: Vec<u32>,
    /// Corner codes of dead tetrahedra whose face is on the boundary.
    boundary: Vec<u32>,
    /// The new tetrahedra, all with the inserted vertex in slot 0.
    pub fresh: Vec<u32>,
    /// Flagged edges that the last constrained insertion destroyed.
    pub lost_edges: Vec<[u32; 2]>,
    /// Per vertex its local number in the current cavity, valid only if `local_vertex` agrees (so it is never reset).
    local_number: Vec<u8>,
    local_vertex: [u32; LOCAL],
    local_ghost: u8,
    local_count: usize,
    half_edges: Vec<u32>,
    sorted_edges: Vec<(u64, u32)>,
}

impl Cavity {
    /// Makes room for vertices with ids below `vertex_count`.
    pub fn prepare(&mut self, vertex_count: usize) -> Result<(), Error> {
        if self.local_number.len() < vertex_count {
            self.local_number.try_reserve(vertex_count - self.local_number.len())?;
            self.local_number.resize(vertex_count, 0);
        }
        if self.half_edges.is_empty() {
            self.half_edges.try_reserve(LOCAL * LOCAL)?;
            self.half_edges.resize(LOCAL * LOCAL, 0);
        }
        Ok(())
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        self.local_number.capacity()
            + 4 * (self.dead.capacity()
                + self.boundary.capacity()
                + self.fresh.capacity()
                + self.half_edges.capacity())
            + 16 * self.sorted_edges.capacity()
            + 8 * self.lost_edges.capacity()
    }

    /// The local number of a vertex, or None if all are taken.
    #[inline(always)]
    fn local(&mut self, v: u32) -> Option<usize> {
        if v == GHOST {
            if self.local_ghost as usize >= self.local_count
                || self.local_vertex[self.local_ghost as usize] != GHOST
            {
                if self.local_count == LOCAL {
                    return None;
                }
                self.local_ghost = self.local_count as u8;
                self.local_vertex[self.local_count] = GHOST;
                self.local_count += 1;
            }
            return Some(self.local_ghost as usize);
        }
        let l = self.local_number[v as usize] as usize;
        if l < self.local_count && self.local_vertex[l] == v {
            return Some(l);
        }
        if self.local_count == LOCAL {
            return None;
        }
        let l = self.local_count;
        self.local_number[v as usize] = l as u8;
        self.local_vertex[l] = v;
        self.local_count += 1;
        Some(l)
    }
}

impl Delaunay {
    /// The (perturbed) circumsphere of `t` contains `p`; for a ghost: its hull face sees `p`, or `p` lies in the plane of the
    /// hull face and inside the sphere of the finite tetrahedron behind it.
    #[inline(always)]
    pub fn in_conflict(&self, points: &Points, t: u32, p: u32) -> bool {
        let v = &self.mesh.verts[t as usize];
        if v[3] != GHOST {
            return points.insphere_perturbed(v[0], v[1], v[2], v[3], p) == Sign::Positive;
        }
        match points.orient3d(v[0], v[1], v[2], p) {
            Sign::Positive => true,
            Sign::Negative => false,
            Sign::Zero => {
                let w = &self.mesh.verts[(self.mesh.adj[t as usize][3] >> 2) as usize];
                points.insphere_perturbed(w[0], w[1], w[2], w[3], p) == Sign::Positive
            }
        }
    }

    /// Inserts `p`, which is in conflict with tetrahedron `t`. Returns a new finite or ghost tetrahedron with vertex `p`.
    pub fn insert_at<const CONSTRAINED: bool>(
        &mut self,
        points: &Points,
        p: u32,
        t: u32,
    ) -> Result<u32, Error> {
        self.collect_conflicts(points, p, t)?;
        self.fill::<CONSTRAINED>(p)?;
        if CONSTRAINED {
            self.carry_edge_flags();
        }
        for i in 0..self.cavity.dead.len() {
            self.mesh.release(self.cavity.dead[i]);
        }
        Ok(self.cavity.fresh[0])
    }

    /// Fills `dead` (marked) and `boundary`.
    fn collect_conflicts(&mut self, points: &Points, p: u32, t: u32) -> Result<(), Error> {
        self.cavity.dead.clear();
        self.cavity.boundary.clear();
        self.cavity.dead.push(t);
        self.mesh.flags[t as usize] |= flag::MARK;
        let mut next = 0;
        while next < self.cavity.dead.len() {
            let c = self.cavity.dead[next];
            next += 1;
            self.cavity.dead.try_reserve(4)?;
            self.cavity.boundary.try_reserve(4)?;
            let adj = self.mesh.adj[c as usize];
            for f in 0..4u32 {
                let n = adj[f as usize] >> 2;
                if self.mesh.flags[n as usize] & flag::MARK != 0 {
                    continue;
                }
                if self.in_conflict(points, n, p) {
                    self.mesh.flags[n as usize] |= flag::MARK;
                    self.cavity.dead.push(n);
                } else {
                    self.cavity.boundary.push(4 * c + f);
                }
            }
        }
        Ok(())
    }

    /// Joins `p` to the boundary faces and links the new tetrahedra.
    fn fill<const CONSTRAINED: bool>(&mut self, p: u32) -> Result<(), Error> {
        let count = self.cavity.boundary.len();
        self.mesh.reserve(count)?;
        self.cavity.fresh.clear();
        self.cavity.fresh.try_reserve(count)?;
        self.cavity.local_count = 0;
        let mut small = true;
        for i in 0..count {
            let code = self.cavity.boundary[i];
            let mut b = self.mesh.face(code);
            if b[0] == GHOST {
                b = [b[1], b[2], b[0]];
            } else if b[1] == GHOST {
                b = [b[2], b[0], b[1]];
            }
            let outer = self.mesh.across(code);
            let t = self.mesh.allocate([p, b[0], b[1], b[2]]);
            self.mesh.link(4 * t, outer);
            self.cavity.fresh.push(t);
            if CONSTRAINED {
                for v in b {
                    if v != GHOST {
                        self.vertex_tet[v as usize] = t;
                    }
                }
            }
            if small {
                match (self.cavity.local(b[0]), self.cavity.local(b[1]), self.cavity.local(b[2])) {
                    (Some(i0), Some(i1), Some(i2)) => {
                        let table = &mut self.cavity.half_edges;
                        table[i1 * LOCAL + i2] = 4 * t + 1;
                        table[i2 * LOCAL + i0] = 4 * t + 2;
                        table[i0 * LOCAL + i1] = 4 * t + 3;
                    }
                    _ => small = false,
                }
            }
        }
        if small {
            self.link_by_table();
        } else {
            self.link_by_sorting()?;
        }
        if CONSTRAINED {
            self.vertex_tet[p as usize] = self.cavity.fresh[0];
        }
        Ok(())
    }

    fn link_by_table(&mut self) {
        for k in 0..self.cavity.fresh.len() {
            let t = self.cavity.fresh[k];
            let [_, b0, b1, b2] = self.mesh.verts[t as usize];
            let local = |v: u32| -> usize {
                if v == GHOST {
                    self.cavity.local_ghost as usize
                } else {
                    self.cavity.local_number[v as usize] as usize
                }
            };
            let (i0, i1, i2) = (local(b0), local(b1), local(b2));
            let table = &self.cavity.half_edges;
            let adj = &mut self.mesh.adj[t as usize];
            adj[1] = table[i2 * LOCAL + i1];
            adj[2] = table[i0 * LOCAL + i2];
            adj[3] = table[i1 * LOCAL + i0];
        }
    }

    #[cold]
    fn link_by_sorting(&mut self) -> Result<(), Error> {
        let edges = &mut self.cavity.sorted_edges;
        edges.clear();
        edges.try_reserve(3 * self.cavity.fresh.len())?;
        for &t in &self.cavity.fresh {
            let v = self.mesh.verts[t as usize];
            for f in 1..4u32 {
                let (a, b) = (v[(f % 3 + 1) as usize], v[((f + 1) % 3 + 1) as usize]);
                edges.push(((a.min(b) as u64) << 32 | a.max(b) as u64, 4 * t + f));
            }
        }
        edges.sort_unstable();
        for pair in edges.chunks_exact(2) {
            if pair[0].0 != pair[1].0 {
                return Err(Error::internal("the boundary of a cavity is not closed"));
            }
            let (a, b) = (pair[0].1, pair[1].1);
            self.mesh.adj[(a >> 2) as usize][(a & 3) as usize] = b;
            self.mesh.adj[(b >> 2) as usize][(b & 3) as usize] = a;
        }
        Ok(())
    }

    /// Gives the new tetrahedra the subsegment flags of the boundary's edges and lists the flagged edges that are gone.
    fn carry_edge_flags(&mut self) {
        self.cavity.lost_edges.clear();
        for i in 0..self.cavity.dead.len() {
            let t = self.cavity.dead[i];
            let mut bits = (self.mesh.flags[t as usize] & flag::EDGES) >> 4;
            while bits != 0 {
                let e = bits.trailing_zeros() as usize;
                bits &= bits - 1;
                let v = self.mesh.verts[t as usize];
                let (a, b) = (v[EDGE[e][0] as usize], v[EDGE[e][1] as usize]);
                let edge = [a.min(b), a.max(b)];
                if !self.cavity.lost_edges.contains(&edge) {
                    self.cavity.lost_edges.push(edge);
                }
            }
        }
        if self.cavity.lost_edges.is_empty() {
            return;
        }
        // `fresh[i]` was made from `boundary[i]`: copy the flags of the face's edges.
        for i in 0..self.cavity.boundary.len() {
            let code = self.cavity.boundary[i];
            let flags = self.mesh.flags[(code >> 2) as usize];
            if flags & flag::EDGES == 0 {
                continue;
            }
            let face = FACE[(code & 3) as usize];
            let old = self.mesh.verts[(code >> 2) as usize];
            let t = self.cavity.fresh[i];
            for k in 0..3 {
                let (x, y) = (face[k], face[(k + 1) % 3]);
                if flags & (flag::EDGE << EDGE_OF[x as usize][y as usize]) == 0 {
                    continue;
                }
                let (a, b) = (old[x as usize], old[y as usize]);
                let (Some(m), Some(n)) = (self.mesh.slot_of(t, a), self.mesh.slot_of(t, b)) else { continue };
                self.mesh.flags[t as usize] |= flag::EDGE << EDGE_OF[m as usize][n as usize];
                let edge = [a.min(b), a.max(b)];
                if let Some(at) = self.cavity.lost_edges.iter().position(|&lost| lost == edge) {
                    self.cavity.lost_edges.swap_remove(at);
                }
            }
        }
    }

    /// A new tetrahedron of the last insertion with vertex `v`, or NONE.
    pub fn fresh_with(&self, v: u32) -> u32 {
        self.cavity.fresh.iter().copied().find(|&t| self.mesh.verts[t as usize].contains(&v)).unwrap_or(NONE)
    }
}
