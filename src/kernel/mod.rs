//! Tetrahedra and their adjacency: topology only, no coordinates.
//!
//! A structure of arrays. The convex hull is closed by *ghost tetrahedra* `(a, b, c, GHOST)`: their first three vertices are a hull face,
//! oriented as seen from outside like any face from its tetrahedron, so cavity code needs no special case. The ghost vertex is always in
//! slot 3.
//!
//! Invariants between operations: every live tetrahedron has four live neighbours; `adj[adj[c]] == c` for every corner code
//! `c = 4·t + f`; the two tetrahedra share the three vertices of that face.
#[cfg(test)]
pub mod check;
pub mod journal;
pub mod lookup;
pub mod refill;
pub mod slots;
pub mod star;
pub mod tables;

use crate::error::{Error, Status};
use slots::Slots;
use tables::FACE;

/// The vertex at infinity.
pub const GHOST: u32 = u32::MAX;
/// No tetrahedron.
pub const NONE: u32 = u32::MAX;
/// The most tetrahedra that corner codes can address: with one more, the code of its corner 3 would be [`NONE`].
pub const MAX_TETS: usize = (1 << 30) - 1;
const _: () = assert!(4 * (MAX_TETS - 1) + 3 < NONE as usize);

/// An unordered vertex pair as a key.
#[inline]
pub fn edge_key(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// An unordered vertex triple as a key.
#[inline]
pub fn face_key([a, b, c]: [u32; 3]) -> [u32; 3] {
    let (low, high) = (a.min(b), a.max(b));
    [low.min(c), high.min(c).max(low), high.max(c)]
}

/// Flag bits of a tetrahedron.
pub mod flag {
    /// Bit of face 0 being a subface; face `i` is `FACE << i`.
    pub const FACE: u16 = 1;
    /// All four face bits.
    pub const FACES: u16 = 0xf;
    /// Bit of edge 0 being a subsegment; edge `i` is `EDGE << i`.
    pub const EDGE: u16 = 1 << 4;
    /// All six edge bits.
    pub const EDGES: u16 = 0x3f << 4;
    /// The number of the range that owns the tetrahedron while several workers insert vertices; 0 if none does. There are no subfaces or
    /// subsegments at that time.
    pub const OWNER: u16 = FACES | EDGES;
    /// A scratch mark: clear between operations.
    pub const MARK: u16 = 1 << 10;
    /// The slot is free.
    pub const DEAD: u16 = 1 << 11;
    /// Another scratch mark: clear between operations.
    pub const MET: u16 = 1 << 12;
}

/// Tetrahedra with vertices, neighbours and flags.
#[derive(Clone, Debug, Default)]
pub struct Tetrahedra {
    /// Vertices of each tetrahedron.
    pub verts: Vec<[u32; 4]>,
    /// Corner codes: `4·t' + f'` of the neighbour across each face and the face as seen from there.
    pub adj: Vec<[u32; 4]>,
    /// Flag bits, see [`flag`].
    pub flags: Vec<u16>,
    /// Free slots.
    pub free: Vec<u32>,
}

impl Tetrahedra {
    /// Forgets everything, keeps the memory.
    pub fn clear(&mut self) {
        self.verts.clear();
        self.adj.clear();
        self.flags.clear();
        self.free.clear();
    }

    /// The number of slots (live and free).
    #[inline(always)]
    pub fn slot_count(&self) -> usize {
        self.verts.len()
    }

    /// The number of live tetrahedra, including ghosts.
    pub fn live_count(&self) -> usize {
        self.verts.len() - self.free.len()
    }

    /// Bytes held by the arrays.
    pub fn bytes(&self) -> usize {
        self.verts.capacity() * 16
            + self.adj.capacity() * 16
            + self.flags.capacity() * 2
            + self.free.capacity() * 4
    }

    /// Makes room for `extra` more slots.
    #[inline(always)]
    pub fn reserve(&mut self, extra: usize) -> Result<(), Error> {
        if self.verts.capacity() - self.verts.len() < extra
            || self.flags.capacity() - self.flags.len() < extra
        {
            self.grow(extra)?;
        }
        Ok(())
    }

    /// A view for readers.
    #[inline(always)]
    pub(crate) fn slots(&self) -> Slots<'_> {
        Slots::read(self)
    }

    /// A view for one writer.
    #[inline(always)]
    pub(crate) fn exclusive(&mut self) -> Slots<'_> {
        Slots::exclusive(self)
    }

    /// A view for several writers with room for `more` new tetrahedra.
    pub(crate) fn share(&mut self, more: usize) -> Result<Slots<'_>, Error> {
        if self.verts.len() + more > MAX_TETS {
            return Err(Error::new(
                Status::TooLarge,
                "more tetrahedra than the library can address, 2^30 - 1",
            ));
        }
        self.verts.try_reserve_exact(more)?;
        self.adj.try_reserve_exact(more)?;
        self.flags.try_reserve_exact(more)?;
        Ok(Slots::shared(self, more))
    }

    /// Makes room for about `extra` more slots if there is memory. This is only a hint: growth reserves again.
    pub(crate) fn expect(&mut self, extra: usize) {
        let extra = extra.min(MAX_TETS.saturating_sub(self.verts.len()));
        let _ = self.verts.try_reserve_exact(extra);
        let _ = self.adj.try_reserve_exact(extra);
        let _ = self.flags.try_reserve_exact(extra);
    }

    #[cold]
    #[inline(never)]
    fn grow(&mut self, extra: usize) -> Result<(), Error> {
        if self.verts.len() + extra > MAX_TETS {
            return Err(Error::new(
                Status::TooLarge,
                "more tetrahedra than the library can address, 2^30 - 1",
            ));
        }
        // Grow by a quarter instead of doubling: most of the memory of a large mesh is here.
        let room = extra.max(self.verts.len() / 4).min(MAX_TETS - self.verts.len());
        self.verts.try_reserve_exact(room)?;
        self.adj.try_reserve_exact(room)?;
        self.flags.try_reserve_exact(room)?;
        self.free.try_reserve(extra)?;
        Ok(())
    }

    /// A slot for a new tetrahedron: a free one or a new one at the end. Its content is undefined except for the vertices.
    #[inline(always)]
    pub fn allocate(&mut self, verts: [u32; 4]) -> u32 {
        if let Some(t) = self.free.pop() {
            self.verts[t as usize] = verts;
            self.flags[t as usize] = 0;
            t
        } else {
            let t = self.verts.len() as u32;
            self.verts.push(verts);
            self.adj.push([NONE; 4]);
            self.flags.push(0);
            t
        }
    }

    /// Appends `count` slots for new tetrahedra to `slots`. Their content is undefined.
    #[inline(always)]
    pub fn allocate_all(&mut self, count: usize, slots: &mut Vec<u32>) -> Result<(), Error> {
        slots.try_reserve(count)?;
        let recycled = count.min(self.free.len());
        let kept = self.free.len() - recycled;
        slots.extend_from_slice(&self.free[kept..]);
        self.free.truncate(kept);
        let added = count - recycled;
        if added > 0 {
            self.reserve(added)?;
            let length = self.verts.len();
            slots.extend(length as u32..(length + added) as u32);
            self.verts.resize(length + added, [NONE; 4]);
            self.adj.resize(length + added, [NONE; 4]);
            self.flags.resize(length + added, 0);
        }
        Ok(())
    }

    /// Frees a slot.
    #[inline(always)]
    pub fn release(&mut self, t: u32) {
        self.flags[t as usize] = flag::DEAD;
        self.free.push(t);
    }

    /// Whether the slot is in use.
    #[inline(always)]
    pub fn is_live(&self, t: u32) -> bool {
        self.flags[t as usize] & flag::DEAD == 0
    }

    /// Whether the tetrahedron has the vertex at infinity.
    #[inline(always)]
    pub fn is_ghost(&self, t: u32) -> bool {
        self.verts[t as usize][3] == GHOST
    }

    /// Makes two corner codes neighbours.
    #[inline(always)]
    pub fn link(&mut self, a: u32, b: u32) {
        self.adj[(a >> 2) as usize][(a & 3) as usize] = b;
        self.adj[(b >> 2) as usize][(b & 3) as usize] = a;
    }

    /// The corner code across corner code `c`.
    #[inline(always)]
    pub fn across(&self, c: u32) -> u32 {
        self.adj[(c >> 2) as usize][(c & 3) as usize]
    }

    /// The vertices of the face opposite corner `c`, ordered so that `(opposite, x, y, z)` is positive.
    #[inline(always)]
    pub fn face(&self, c: u32) -> [u32; 3] {
        let v = &self.verts[(c >> 2) as usize];
        let f = &FACE[(c & 3) as usize];
        [v[f[0] as usize], v[f[1] as usize], v[f[2] as usize]]
    }

    /// Flags the face of corner `c` as a subface, on both sides.
    pub fn flag_face(&mut self, c: u32) {
        for side in [c, self.across(c)] {
            self.flags[(side >> 2) as usize] |= flag::FACE << (side & 3);
        }
    }

    /// The vertex of corner `c`.
    #[inline(always)]
    pub fn apex(&self, c: u32) -> u32 {
        self.verts[(c >> 2) as usize][(c & 3) as usize]
    }

    /// The slot of vertex `v` in tetrahedron `t`, if it is one of its vertices.
    #[inline(always)]
    pub fn slot_of(&self, t: u32, v: u32) -> Option<u32> {
        let w = &self.verts[t as usize];
        (0..4u32).find(|&i| w[i as usize] == v)
    }
}
