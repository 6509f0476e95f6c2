//! Insertion of a vertex (Bowyer 1981, Watson 1981), with adjacency in O(1) per face.
//!
//! The boundary faces of the conflict region are joined to the new vertex, and the new tetrahedra are linked through a table
//! indexed by *local* vertex numbers: the boundary's vertices are renumbered from 0, and the half-edge `i → j` of each boundary face is
//! stored at `32·i + j` (as in Marot, Pellerin & Remacle 2019).
//! Cavities with more than 32 vertices pair their half-edges in a hash table.
//!
//! New tetrahedra reuse the slots of the dead ones, which are in the processor's caches. Not so with `CONSTRAINED`, where the subsegment
//! flags of dead tetrahedra are carried over: a flagged edge either lies on the boundary of the cavity, where new tetrahedra inherit the
//! flag, or is lost and reported in `lost_edges`.
//!
//! With `WEIGHTED` a cavity may have vertices inside: they have no tetrahedron any more, and never get one again.
use crate::control::Control;
use crate::delaunay::conflicts::Conflicts;
use crate::delaunay::edge_table::EdgeTable;
use crate::error::Error;
use crate::fallible;
use crate::kernel::slots::Slots;
use crate::kernel::tables::{EDGE, EDGE_OF};
use crate::kernel::{Mesh, GHOST};
use crate::predicates::Points;

/// Boundary vertices that the table can number: a power of two.
const LOCAL: u32 = 32;
/// Entries of the table.
const ENTRIES: usize = (LOCAL * LOCAL) as usize;
/// The slots, in a new tetrahedron, of the edge of the boundary half-edge with this corner; the first entry is never used.
const HALF_EDGE: [[u8; 2]; 4] = [[0, 0], [2, 3], [3, 1], [1, 2]];

/// Inserts vertices; keeps its scratch space.
#[derive(Default)]
pub struct Inserter {
    pub(super) conflicts: Conflicts,
    /// The new tetrahedra, all with the inserted vertex in slot 0.
    pub fresh: Vec<u32>,
    /// Flagged edges that the last constrained insertion destroyed.
    pub lost_edges: Vec<[u32; 2]>,
    numbers: LocalNumbers,
    half_edges: HalfEdges,
    /// The half-edges if there are too many vertices for `half_edges`.
    wide_edges: EdgeTable,
}

/// Corner codes of directed edges by the local numbers of their ends.
struct HalfEdges([u32; ENTRIES]);

impl Default for HalfEdges {
    fn default() -> Self {
        HalfEdges([0; ENTRIES])
    }
}

impl HalfEdges {
    #[inline(always)]
    fn set(&mut self, i: u32, j: u32, code: u32) {
        self.0[(LOCAL * i + j) as usize % ENTRIES] = code;
    }

    #[inline(always)]
    fn get(&self, i: u32, j: u32) -> u32 {
        self.0[(LOCAL * i + j) as usize % ENTRIES]
    }
}

/// Numbers, from 0, for the vertices of one cavity's boundary.
#[derive(Default)]
struct LocalNumbers {
    /// For each vertex (the ghost first): the stamp of the last cavity in which it was numbered, with its number in the low bits.
    of_vertex: Vec<u32>,
    /// The stamp of the current cavity: a multiple of `LOCAL`, never 0.
    stamp: u32,
    /// How many vertices are numbered; beyond `LOCAL`, numbers are no longer distinct.
    count: u32,
}

impl LocalNumbers {
    /// Forgets all numbers.
    #[inline(always)]
    fn clear(&mut self) {
        self.count = 0;
        self.stamp = self.stamp.wrapping_add(LOCAL);
        if self.stamp == 0 {
            // Stamps repeat after 2^27 cavities.
            self.of_vertex.fill(0);
            self.stamp = LOCAL;
        }
    }

    /// The number of a vertex or of the ghost; assigns one if it is new.
    #[inline(always)]
    fn of(&mut self, v: u32) -> u32 {
        let entry = &mut self.of_vertex[v.wrapping_add(1) as usize];
        let number = *entry ^ self.stamp;
        let known = number < LOCAL;
        // Branch-free: about every fifth vertex is new, unpredictably.
        let number = if known { number } else { self.count % LOCAL };
        self.count += !known as u32;
        *entry = self.stamp | number;
        number
    }

    /// The number of a vertex if it has one; otherwise any number.
    #[inline(always)]
    fn last(&self, v: u32) -> u32 {
        self.of_vertex[v.wrapping_add(1) as usize] % LOCAL
    }
}

impl Inserter {
    /// Makes room for vertices with ids below `vertex_count`.
    pub fn prepare(&mut self, vertex_count: usize) -> Result<(), Error> {
        let numbers = &mut self.numbers.of_vertex;
        let count = numbers.len().max(vertex_count + 1);
        Ok(fallible::resize(numbers, count, 0)?)
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        4 * (self.numbers.of_vertex.capacity() + self.fresh.capacity() + ENTRIES)
            + self.conflicts.bytes()
            + self.wide_edges.bytes()
            + 8 * self.lost_edges.capacity()
    }

    /// Sets `fresh` to slots of dead tetrahedra, as many as there are new ones.
    #[inline(always)]
    pub(super) fn reuse_slots(&mut self) -> Result<(), Error> {
        let dead = self.conflicts.dead();
        let count = dead.len().min(self.conflicts.face_count());
        self.fresh.clear();
        fallible::append(&mut self.fresh, &dead[..count])?;
        Ok(())
    }

    /// Joins `p` to the boundary faces, in the slots `fresh`, and links the new tetrahedra, which get `flags`. Consumes the list of faces.
    pub(super) fn fill(&mut self, slots: &Slots, flags: u16, p: u32) -> Result<(), Error> {
        let Inserter { conflicts, fresh, numbers, half_edges, .. } = self;
        numbers.clear();
        for (face, &t) in conflicts.faces().iter_mut().zip(&*fresh) {
            let [a, b, c, outer] = *face;
            slots.set_across(outer, 4 * t);
            slots.set_verts(t, [p, a, b, c]);
            slots.set_flags(t, flags);
            let [i, j, k] = [numbers.of(a), numbers.of(b), numbers.of(c)];
            half_edges.set(j, k, 4 * t + 1);
            half_edges.set(k, i, 4 * t + 2);
            half_edges.set(i, j, 4 * t + 3);
            *face = [i, j, k, outer];
        }
        if numbers.count > LOCAL {
            return self.link_by_hash(slots);
        }
        for (&mut [i, j, k, outer], &t) in conflicts.faces().iter_mut().zip(&*fresh) {
            slots.set_adj(t, [outer, half_edges.get(k, j), half_edges.get(i, k), half_edges.get(j, i)]);
        }
        Ok(())
    }

    #[inline(never)]
    fn link_by_hash(&mut self, slots: &Slots) -> Result<(), Error> {
        let edges = &mut self.wide_edges;
        edges.clear(3 * self.fresh.len())?;
        for &t in &self.fresh {
            let [_, a, b, c] = slots.verts(t);
            edges.insert(b, c, 4 * t + 1);
            edges.insert(c, a, 4 * t + 2);
            edges.insert(a, b, 4 * t + 3);
        }
        for (&t, &mut [.., outer]) in self.fresh.iter().zip(self.conflicts.faces()) {
            let [_, a, b, c] = slots.verts(t);
            let (Some(x), Some(y), Some(z)) = (edges.get(c, b), edges.get(a, c), edges.get(b, a)) else {
                return Err(Error::internal("the boundary of a cavity is not closed"));
            };
            slots.set_adj(t, [outer, x, y, z]);
        }
        Ok(())
    }
}

impl Inserter {
    /// Inserts `p`, which is in conflict with tetrahedron `t`. Returns a new finite or ghost tetrahedron with vertex `p`. If the run is ended
    /// within, the mesh is useless.
    pub fn insert<const CONSTRAINED: bool, const WEIGHTED: bool>(
        &mut self,
        mesh: &mut Mesh,
        points: &Points,
        p: u32,
        t: u32,
        control: &Control,
    ) -> Result<u32, Error> {
        self.conflicts.collect::<false, WEIGHTED>(&mesh.exclusive(), 0, points, p, t, &|| control.look())?;
        if CONSTRAINED {
            self.fresh.clear();
        } else {
            self.reuse_slots()?;
        }
        let reused = self.fresh.len();
        mesh.allocate_all(self.conflicts.face_count() - reused, &mut self.fresh)?;
        self.fill(&mesh.exclusive(), 0, p)?;
        if CONSTRAINED {
            for &t in &self.fresh {
                for v in mesh.verts(t).into_iter().skip(1).filter(|&v| v != GHOST) {
                    mesh.vertex_tet[v as usize] = t;
                }
            }
            mesh.vertex_tet[p as usize] = self.fresh[0];
            self.carry_edge_flags(mesh, p, control)?;
        }
        for &t in &self.conflicts.dead()[reused..] {
            mesh.release(t)?;
        }
        Ok(self.fresh[0])
    }

    /// Makes the boundary's subsegments those of the new tetrahedra and lists the subsegments that were destroyed.
    ///
    /// The half-edges of the boundary tell which edges of dead tetrahedra are on it, and which new tetrahedra have them: one per direction.
    fn carry_edge_flags(&mut self, mesh: &mut Mesh, p: u32, control: &Control) -> Result<(), Error> {
        self.lost_edges.clear();
        for i in 0..self.conflicts.dead().len() {
            let t = self.conflicts.dead()[i];
            let mut bits = mesh.subsegment_bits(t);
            while bits != 0 {
                let e = bits.trailing_zeros() as usize;
                bits &= bits - 1;
                let v = mesh.verts(t);
                let (a, b) = (v[EDGE[e][0] as usize], v[EDGE[e][1] as usize]);
                let (Some(there), Some(back)) =
                    (self.half_edge(mesh, p, a, b), self.half_edge(mesh, p, b, a))
                else {
                    let edge = [a.min(b), a.max(b)];
                    control.steps(1 + self.lost_edges.len() as u32 / 256)?;
                    if !self.lost_edges.contains(&edge) {
                        fallible::push(&mut self.lost_edges, edge)?;
                    }
                    continue;
                };
                for code in [there, back] {
                    let [x, y] = HALF_EDGE[(code & 3) as usize];
                    mesh.set_subsegment(code >> 2, EDGE_OF[x as usize][y as usize]);
                }
            }
        }
        Ok(())
    }

    /// The corner code of the boundary's half-edge from `a` to `b` in the tetrahedron that joins it to `p`, if it is on the boundary.
    #[inline(always)]
    fn half_edge(&self, mesh: &Mesh, p: u32, a: u32, b: u32) -> Option<u32> {
        let Inserter { numbers, half_edges, wide_edges, .. } = self;
        if numbers.count > LOCAL {
            return wide_edges.get(a, b);
        }
        // Stale entries of earlier cavities are recognized by their vertices: no other tetrahedra have `p`.
        let code = half_edges.get(numbers.last(a), numbers.last(b));
        if (code >> 2) as usize >= mesh.slot_count() {
            return None;
        }
        let v = mesh.verts(code >> 2);
        let [x, y] = HALF_EDGE[(code & 3) as usize];
        (v[0] == p && v[x as usize] == a && v[y as usize] == b).then_some(code)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn local_numbers_are_forgotten_even_when_stamps_return() {
        let mut numbers = LocalNumbers { of_vertex: vec![0; 8], ..LocalNumbers::default() };
        numbers.clear();
        assert_eq!([numbers.of(3), numbers.of(GHOST), numbers.of(3), numbers.of(6)], [0, 1, 0, 2]);
        // The stamp of that cavity repeats after this one.
        numbers.stamp = LOCAL.wrapping_neg();
        numbers.clear();
        assert_eq!([numbers.of(6), numbers.of(3), numbers.of(GHOST), numbers.count], [0, 1, 2, 3]);
    }
}
