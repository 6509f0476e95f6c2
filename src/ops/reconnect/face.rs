//! Oriented faces by local vertex numbers, and the front: those whose inner side is open.
use crate::error::Error;
use crate::ops::reconnect::MOST_VERTICES;

/// A face, with its three numbers in one word: the vertex with the smallest id first, oriented so that the side to be filled is positive.
/// Equal faces are equal words.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Face(u32);

impl Face {
    /// The face with these corners. `ids`: vertex ids by local number.
    #[inline(always)]
    pub fn new([x, y, z]: [u8; 3], ids: &[u32]) -> Face {
        let [p, q, r] = [x, y, z].map(|i| ids[i as usize]);
        Face(u32::from_le_bytes(if p < q && p < r {
            [x, y, z, 0]
        } else if q < r {
            [y, z, x, 0]
        } else {
            [z, x, y, 0]
        }))
    }

    /// Its corners, the one with the smallest id first.
    #[inline(always)]
    pub fn corners(self) -> [u8; 3] {
        let [x, y, z, _] = self.0.to_le_bytes();
        [x, y, z]
    }

    /// The same face from the other side.
    #[inline(always)]
    pub fn reversed(self) -> Face {
        let [x, y, z, _] = self.0.to_le_bytes();
        Face(u32::from_le_bytes([x, z, y, 0]))
    }

    /// Its corners as bits.
    #[inline(always)]
    pub fn mask(self) -> u64 {
        let [x, y, z] = self.corners();
        1 << x | 1 << y | 1 << z
    }

    /// The three faces of the tetrahedron `(w, self)` other than `self`, as seen from inside it; each opposite the corresponding corner of
    /// `self`.
    #[inline(always)]
    pub fn others(self, w: u8, ids: &[u32]) -> [Face; 3] {
        let [x, y, z] = self.corners();
        [Face::new([w, z, y], ids), Face::new([w, x, z], ids), Face::new([w, y, x], ids)]
    }
}

/// The vertices on each side of a face's plane, as bit sets. Those in the plane are in neither.
#[derive(Clone, Copy, Default, Debug)]
pub struct Sides {
    /// On the side to be filled.
    pub ahead: u64,
    /// On the other side.
    pub behind: u64,
}

impl Sides {
    /// Whether two points are on different sides.
    pub fn part(self, [p, q]: [u8; 2]) -> bool {
        let (p, q) = (1 << p, 1 << q);
        (self.ahead & p != 0 && self.behind & q != 0) || (self.ahead & q != 0 && self.behind & p != 0)
    }

    /// As seen from the other side.
    pub fn reversed(self) -> Sides {
        Sides { ahead: self.behind, behind: self.ahead }
    }
}

/// Removes the lowest number from a set and returns it; `None` if the set is empty.
#[inline(always)]
pub fn take_lowest(set: &mut u64) -> Option<u8> {
    let lowest = set.trailing_zeros() as u8;
    let some = *set != 0;
    *set &= set.wrapping_sub(1);
    some.then_some(lowest)
}

/// Faces whose inner side is open. They form a closed surface: each edge is used equally often in both directions.
#[derive(Default)]
pub struct Front {
    /// The faces.
    pub faces: Vec<Face>,
    /// Their sides; unknown if both sets are empty.
    pub sides: Vec<Sides>,
}

impl Front {
    /// Removes all, and makes room.
    pub fn clear(&mut self, room: usize) -> Result<(), Error> {
        self.faces.clear();
        self.sides.clear();
        self.reserve(room)
    }

    /// Makes room for more.
    pub fn reserve(&mut self, more: usize) -> Result<(), Error> {
        self.faces.try_reserve(more)?;
        self.sides.try_reserve(more)?;
        Ok(())
    }

    /// Appends a face; there must be room.
    #[expect(clippy::disallowed_methods, reason = "the search has made room")]
    pub fn push(&mut self, face: Face, sides: Sides) {
        self.faces.push(face);
        self.sides.push(sides);
    }

    /// Removes the face at an index; the last one moves there.
    pub fn swap_remove(&mut self, at: usize) -> (Face, Sides) {
        (self.faces.swap_remove(at), self.sides.swap_remove(at))
    }

    /// Collects for each vertex the vertices joined to it by an edge.
    pub fn collect_neighbours(&self, neighbours: &mut [u64; MOST_VERTICES]) {
        *neighbours = [0; MOST_VERTICES];
        for face in &self.faces {
            let [x, y, z] = face.corners();
            // The other faces contribute the other directions.
            neighbours[x as usize] |= 1 << y;
            neighbours[y as usize] |= 1 << z;
            neighbours[z as usize] |= 1 << x;
        }
    }
}
