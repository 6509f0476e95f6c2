//! The mesh: tetrahedra, their adjacency, and what hangs on them. Topology alone, no coordinates.
//!
//! A structure of arrays ([`cells`]). Any domain is closed by *ghost tetrahedra* `(a, b, c, GHOST)` ([`ghosts`]): their first three
//! vertices are a face of its boundary, oriented as seen from outside like any face from its tetrahedron, so cavity code needs no special
//! case. The ghost vertex is always in slot 3.
//!
//! Attachments ([`attach`]): the region of a tetrahedron, the subface on a face, the subsegment on an edge, all found in O(1) and carried by
//! every replacement ([`replace`]). What walks through the mesh reads it only; its scratch space is its own ([`around`], [`visited`]).
//!
//! Invariants between operations: every live tetrahedron has four live neighbours; `adj[adj[c]] == c` for every corner code
//! `c = 4·t + f`; the two tetrahedra share the three vertices of that face, and agree on the subface there. ([`check`] tests them.)
pub mod around;
pub mod attach;
pub mod block;
pub mod budget;
pub mod cavity;
pub mod cells;
#[cfg(test)]
pub mod check;
pub mod ghosts;
pub mod given;
pub mod journal;
pub mod lookup;
pub mod replace;
pub mod slots;
pub mod tables;
pub mod visited;

pub use cells::Mesh;

/// The vertex at infinity.
pub const GHOST: u32 = u32::MAX;
/// No tetrahedron, vertex, region or subface.
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

/// The face with the opposite orientation.
pub fn reversed([x, y, z]: [u32; 3]) -> [u32; 3] {
    [x, z, y]
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
    /// The tetrahedron is in conflict with the vertex being inserted: clear between insertions.
    pub const MARK: u16 = 1 << 10;
    /// The slot is free.
    pub const DEAD: u16 = 1 << 11;
    /// The tetrahedron was tested for conflict: clear between insertions.
    pub const MET: u16 = 1 << 12;
}
