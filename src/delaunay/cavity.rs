//! Cavity insertion with adjacency in O(1) per face.
//!
//! The conflict region of a vertex is collected breadth-first, its boundary faces are joined to the vertex, and the new
//! tetrahedra are linked through a table indexed by *local* vertex numbers: the boundary's vertices are renumbered from 0, and
//! the half-edge `i → j` of each boundary face is stored at `32·i + j` (the device of Marot, Pellerin & Remacle 2019).
//! Cavities with more than 32 vertices pair their half-edges in a hash table.
//!
//! With `CONSTRAINED` the subsegment flags of tetrahedra are carried over: a flagged edge either lies on the boundary of
//! the cavity, where new tetrahedra inherit the flag, or is lost and reported in `lost_edges`.
use super::edge_table::EdgeTable;
use super::Delaunay;
use crate::error::Error;
use crate::mesh::tables::{EDGE, EDGE_OF};
use crate::mesh::{flag, Tetrahedra, GHOST, NONE};
use crate::predicates::{Points, Sign};

/// Boundary vertices that the table can number.
const LOCAL: usize = 32;
/// Slots of the edge that the boundary's half-edge with this corner has, in a new tetrahedron; the first entry is never used.
const HALF_EDGE: [[u8; 2]; 4] = [[0, 0], [2, 3], [3, 1], [1, 2]];
/// First length of the lists of faces.
const SCRATCH: usize = 256;

/// Scratch space of an insertion.
#[derive(Clone, Default)]
pub struct Cavity {
    /// Tetrahedra in conflict: the first `dead_count`.
    dead: Vec<u32>,
    dead_count: usize,
    /// Their neighbours.
    dead_adj: Vec<[u32; 4]>,
    /// Corner codes of dead tetrahedra whose face is on the boundary: the first `boundary_count`.
    boundary: Vec<u32>,
    boundary_count: usize,
    /// The new tetrahedra, all with the inserted vertex in slot 0.
    pub fresh: Vec<u32>,
    /// Flagged edges that the last constrained insertion destroyed.
    pub lost_edges: Vec<[u32; 2]>,
    numbers: LocalNumbers,
    /// Local numbers of the vertices of each boundary face (and a filler).
    local_faces: Vec<[u8; 4]>,
    half_edges: [[u32; LOCAL]; LOCAL],
    /// The half-edges where there are too many vertices for `half_edges`.
    wide_edges: EdgeTable,
}

/// Numbers from 0 for the vertices of one cavity's boundary.
#[derive(Clone, Default)]
struct LocalNumbers {
    /// Per vertex its number in the current cavity, valid only if `vertex` agrees (so it is never reset).
    of_vertex: Vec<u8>,
    vertex: [u32; LOCAL],
    ghost: u8,
    /// How many are numbered; beyond `LOCAL` numbers are not distinct any more.
    count: usize,
}

impl LocalNumbers {
    /// The number of a vertex other than the ghost.
    #[inline(always)]
    fn of(&mut self, v: u32) -> u8 {
        let entry = &mut self.of_vertex[v as usize];
        let number = *entry as usize;
        let known = (number < self.count) & (self.vertex[number % LOCAL] == v);
        // No branch: about every fifth vertex is new, at random.
        let number = if known { number } else { self.count % LOCAL };
        self.count += !known as usize;
        *entry = number as u8;
        self.vertex[number] = v;
        number as u8
    }

    /// The numbers of a boundary face's vertices, of which the last may be the ghost.
    #[inline(always)]
    fn of_face(&mut self, [a, b, c]: [u32; 3]) -> [u8; 3] {
        let (a, b) = (self.of(a), self.of(b));
        if c != GHOST {
            return [a, b, self.of(c)];
        }
        let ghost = self.ghost as usize;
        if ghost >= self.count || self.vertex[ghost] != GHOST {
            self.ghost = (self.count % LOCAL) as u8;
            self.vertex[self.count % LOCAL] = GHOST;
            self.count += 1;
        }
        [a, b, self.ghost]
    }
}

/// Lengthens the lists of an insertion.
#[cold]
fn lengthen(
    dead: &mut Vec<u32>,
    dead_adj: &mut Vec<[u32; 4]>,
    boundary: &mut Vec<u32>,
    length: usize,
) -> Result<(), Error> {
    dead.try_reserve(length.saturating_sub(dead.len()))?;
    dead_adj.try_reserve(length.saturating_sub(dead_adj.len()))?;
    boundary.try_reserve(length.saturating_sub(boundary.len()))?;
    dead.resize(length.max(dead.len()), 0);
    dead_adj.resize(length.max(dead_adj.len()), [0; 4]);
    boundary.resize(length.max(boundary.len()), 0);
    Ok(())
}

/// The hull face of a ghost sees `p`, or `p` lies in its plane and inside the sphere of the finite tetrahedron behind it.
#[inline(always)]
fn ghost_in_conflict(verts: &[[u32; 4]], adj: &[[u32; 4]], points: &Points, t: u32, p: u32) -> bool {
    let v = verts[t as usize];
    match points.orient3d(v[0], v[1], v[2], p) {
        Sign::Positive => true,
        Sign::Negative => false,
        Sign::Zero => {
            let w = verts[(adj[t as usize][3] >> 2) as usize];
            points.insphere_perturbed(w[0], w[1], w[2], w[3], p) == Sign::Positive
        }
    }
}

impl Cavity {
    /// Makes room for vertices with ids below `vertex_count`.
    pub fn prepare(&mut self, vertex_count: usize) -> Result<(), Error> {
        let numbers = &mut self.numbers.of_vertex;
        if numbers.len() < vertex_count {
            numbers.try_reserve(vertex_count - numbers.len())?;
            numbers.resize(vertex_count, 0);
        }
        Ok(())
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        self.numbers.of_vertex.capacity()
            + 4 * (5 * self.dead.capacity()
                + self.boundary.capacity()
                + self.fresh.capacity()
                + self.local_faces.capacity()
                + LOCAL * LOCAL)
            + self.wide_edges.bytes()
            + 8 * self.lost_edges.capacity()
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
        ghost_in_conflict(&self.mesh.verts, &self.mesh.adj, points, t, p)
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
            self.carry_edge_flags(p);
        }
        for i in 0..self.cavity.dead_count {
            self.mesh.release(self.cavity.dead[i]);
        }
        Ok(self.cavity.fresh[0])
    }

    /// Fills `dead` (marked) and `boundary`.
    ///
    /// Conflicts are hard to foretell, so each tested neighbour is written behind both lists and only the lengths depend
    /// on the outcome. What the next steps need of a tetrahedron is loaded when it is first met: the tests of others
    /// hide the way to memory.
    fn collect_conflicts(&mut self, points: &Points, p: u32, t: u32) -> Result<(), Error> {
        let at = *points.xyz(p);
        let Tetrahedra { verts, adj, flags, .. } = &mut self.mesh;
        let (verts, adj, flags) = (&verts[..], &adj[..], &mut flags[..]);
        let Cavity { dead, dead_adj, boundary, .. } = &mut self.cavity;
        if dead.len() < SCRATCH {
            lengthen(dead, dead_adj, boundary, SCRATCH)?;
        }
        dead[0] = 4 * t;
        dead_adj[0] = adj[t as usize];
        flags[t as usize] |= flag::MARK;
        let (mut dead_count, mut boundary_count, mut next) = (1, 0, 0);
        // `dead` has corner codes here: the face through which each tetrahedron was entered, so that it is not looked at
        // again. The first one has no such face.
        let mut faces = 4;
        while next < dead_count {
            if dead_count.max(boundary_count) + 4 > dead.len().min(dead_adj.len()).min(boundary.len()) {
                let length = 2 * dead_count.max(boundary_count) + 4;
                lengthen(dead, dead_adj, boundary, length)?;
            }
            let code = dead[next];
            let neighbors = dead_adj[next];
            next += 1;
            let mut untested = [(0, 0, [0; 4]); 4];
            let mut count = 0;
            for turn in 1..=faces {
                let f = (code + turn) % 4;
                let across = neighbors[f as usize];
                let n = (across >> 2) as usize;
                untested[count % 4] = (code & !3 | f, across, verts[n]);
                count += (flags[n] & flag::MARK == 0) as usize;
            }
            faces = 3;
            for &(inner, across, v) in untested.iter().take(count) {
                let n = (across >> 2) as usize;
                let conflict = if v[3] != GHOST {
                    points.inside_perturbed(v, p, &at)
                } else {
                    ghost_in_conflict(verts, adj, points, n as u32, p)
                };
                flags[n] |= flag::MARK * conflict as u16;
                dead[dead_count] = across;
                dead_adj[dead_count] = adj[n];
                dead_count += conflict as usize;
                boundary[boundary_count] = inner;
                boundary_count += !conflict as usize;
            }
        }
        for code in &mut dead[..dead_count] {
            *code >>= 2;
        }
        self.cavity.dead_count = dead_count;
        self.cavity.boundary_count = boundary_count;
        Ok(())
    }

    /// Joins `p` to the boundary faces and links the new tetrahedra.
    fn fill<const CONSTRAINED: bool>(&mut self, p: u32) -> Result<(), Error> {
        let cavity = &mut self.cavity;
        let mesh = &mut self.mesh;
        let count = cavity.boundary_count;
        cavity.fresh.clear();
        mesh.allocate_all(count, &mut cavity.fresh)?;
        cavity.numbers.count = 0;
        if cavity.local_faces.len() < count {
            cavity.local_faces.try_reserve(count)?;
            cavity.local_faces.resize(2 * count, [0; 4]);
        }
        let mut small = true;
        for ((&code, &t), local_face) in
            cavity.boundary[..count].iter().zip(&cavity.fresh).zip(&mut cavity.local_faces)
        {
            let mut b = mesh.face(code);
            if b[0] == GHOST {
                b = [b[1], b[2], b[0]];
            } else if b[1] == GHOST {
                b = [b[2], b[0], b[1]];
            }
            let outer = mesh.across(code);
            mesh.adj[(outer >> 2) as usize][(outer & 3) as usize] = 4 * t;
            mesh.verts[t as usize] = [p, b[0], b[1], b[2]];
            mesh.flags[t as usize] = 0;
            if CONSTRAINED {
                for v in b {
                    if v != GHOST {
                        self.vertex_tet[v as usize] = t;
                    }
                }
            }
            mesh.adj[t as usize][0] = outer;
            if small {
                let [i0, i1, i2] = cavity.numbers.of_face(b);
                small = cavity.numbers.count <= LOCAL;
                let table = &mut cavity.half_edges;
                table[i1 as usize % LOCAL][i2 as usize % LOCAL] = 4 * t + 1;
                table[i2 as usize % LOCAL][i0 as usize % LOCAL] = 4 * t + 2;
                table[i0 as usize % LOCAL][i1 as usize % LOCAL] = 4 * t + 3;
                *local_face = [i0, i1, i2, 0];
            }
        }
        if small {
            self.link_by_table();
        } else {
            self.link_by_hash()?;
        }
        if CONSTRAINED {
            self.vertex_tet[p as usize] = self.cavity.fresh[0];
        }
        Ok(())
    }

    fn link_by_table(&mut self) {
        let table = &self.cavity.half_edges;
        for (&t, &[i0, i1, i2, _]) in self.cavity.fresh.iter().zip(&self.cavity.local_faces) {
            let adj = &mut self.mesh.adj[t as usize];
            adj[1] = table[i2 as usize % LOCAL][i1 as usize % LOCAL];
            adj[2] = table[i0 as usize % LOCAL][i2 as usize % LOCAL];
            adj[3] = table[i1 as usize % LOCAL][i0 as usize % LOCAL];
        }
    }

    #[inline(never)]
    fn link_by_hash(&mut self) -> Result<(), Error> {
        let edges = &mut self.cavity.wide_edges;
        edges.clear(3 * self.cavity.fresh.len())?;
        for &t in &self.cavity.fresh {
            let [_, a, b, c] = self.mesh.verts[t as usize];
            edges.insert(b, c, 4 * t + 1);
            edges.insert(c, a, 4 * t + 2);
            edges.insert(a, b, 4 * t + 3);
        }
        for &t in &self.cavity.fresh {
            let [_, a, b, c] = self.mesh.verts[t as usize];
            let (Some(x), Some(y), Some(z)) = (edges.get(c, b), edges.get(a, c), edges.get(b, a)) else {
                return Err(Error::internal("the boundary of a cavity is not closed"));
            };
            let adj = &mut self.mesh.adj[t as usize];
            [adj[1], adj[2], adj[3]] = [x, y, z];
        }
        Ok(())
    }

    /// Gives the new tetrahedra the subsegment flags of the boundary's edges and lists the flagged edges that are gone.
    ///
    /// The half-edges of the boundary tell which of the dead tetrahedra's edges are on it, and which new tetrahedra have
    /// them: one for each direction.
    fn carry_edge_flags(&mut self, p: u32) {
        self.cavity.lost_edges.clear();
        for i in 0..self.cavity.dead_count {
            let t = self.cavity.dead[i] as usize;
            let mut bits = (self.mesh.flags[t] & flag::EDGES) >> 4;
            while bits != 0 {
                let e = bits.trailing_zeros() as usize;
                bits &= bits - 1;
                let v = self.mesh.verts[t];
                let (a, b) = (v[EDGE[e][0] as usize], v[EDGE[e][1] as usize]);
                let (Some(there), Some(back)) = (self.half_edge(p, a, b), self.half_edge(p, b, a)) else {
                    let edge = [a.min(b), a.max(b)];
                    if !self.cavity.lost_edges.contains(&edge) {
                        self.cavity.lost_edges.push(edge);
                    }
                    continue;
                };
                for code in [there, back] {
                    let [x, y] = HALF_EDGE[(code & 3) as usize];
                    self.mesh.flags[(code >> 2) as usize] |= flag::EDGE << EDGE_OF[x as usize][y as usize];
                }
            }
        }
    }

    /// The corner code of the boundary's half-edge from `a` to `b` in the tetrahedron that joins it to `p`, if it is on the boundary.
    #[inline(always)]
    fn half_edge(&self, p: u32, a: u32, b: u32) -> Option<u32> {
        let Cavity { numbers, half_edges, wide_edges, .. } = &self.cavity;
        if numbers.count > LOCAL {
            return wide_edges.get(a, b);
        }
        // What earlier cavities left in the table is told apart by its vertices: no other tetrahedra have `p`.
        let [i, j] = [a, b].map(|v| numbers.of_vertex[v as usize] as usize % LOCAL);
        let code = half_edges[i][j];
        let v = self.mesh.verts.get((code >> 2) as usize)?;
        let [x, y] = HALF_EDGE[(code & 3) as usize];
        (v[0] == p && v[x as usize] == a && v[y as usize] == b).then_some(code)
    }

    /// A new tetrahedron of the last insertion with vertex `v`, or NONE.
    pub fn fresh_with(&self, v: u32) -> u32 {
        self.cavity.fresh.iter().copied().find(|&t| self.mesh.verts[t as usize].contains(&v)).unwrap_or(NONE)
    }
}
