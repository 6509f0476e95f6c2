//! Which tetrahedra fit on the front.
//!
//! Most do not, usually because an edge of the front pierces one of their faces. That holds as long as the edge is on the front, so the
//! edge is remembered.
use crate::error::Error;
use crate::fallible;
use crate::ops::reconnect::face::{take_lowest, Face};
use crate::ops::reconnect::search::Search;
use crate::ops::reconnect::signs::{choose4, combination};
use crate::predicates::Points;

/// Edges that pierce faces of tetrahedra.
#[derive(Default)]
pub struct Blocks {
    /// For each combination of four vertices an edge and the position of the corner opposite the face that it pierces, as `a + 64 b + 4096
    /// position`; zero if none is known.
    table: Vec<u16>,
}

impl Blocks {
    /// Forgets all entries.
    pub fn clear(&mut self) {
        self.table.clear();
    }

    /// Makes room for `count` vertices.
    pub fn set_count(&mut self, count: usize) -> Result<(), Error> {
        let most = choose4(count);
        if self.table.len() < most {
            fallible::resize(&mut self.table, most, 0)?;
        }
        Ok(())
    }
}

impl Search {
    /// Whether the tetrahedron contains no vertex, its new edges pierce no front face, and no front or required edge pierces its new faces.
    /// `self.neighbours` and the sides of all front faces must be known.
    pub(super) fn is_free(&mut self, points: &Points, w: u8, face: Face, on_front: u64) -> bool {
        let corners = face.corners();
        let [x, y, z] = corners;
        let (index, sorted, _) = combination([w, x, y, z]);
        let place = |corner: u8| sorted.iter().position(|&v| v == corner).unwrap_or(0) as u16;
        let block = self.blocks.table[index];
        let (a, b) = (block & 63, block >> 6 & 63);
        if self.neighbours[a as usize] >> b & 1 == 1 && block >> 12 != place(w) {
            return false;
        }
        let others = face.others(w, &self.signs.vertices);
        let new = others.map(|g| self.sides(points, g));
        let outside = new.iter().fold(self.sides(points, face).behind, |set, g| set | g.behind);
        if on_front & !outside & !face.mask() & !(1 << w) != 0 {
            return false;
        }
        for i in 0..self.edges.len() {
            let edge = self.edges[i];
            for (g, sides) in others.into_iter().zip(new) {
                if sides.part(edge) && self.meets(points, edge, g) {
                    return false;
                }
            }
        }
        for ((g, sides), corner) in others.into_iter().zip(new).zip(corners) {
            let mut ahead = sides.ahead & on_front;
            while let Some(a) = take_lowest(&mut ahead) {
                let mut across = self.neighbours[a as usize] & sides.behind;
                while let Some(b) = take_lowest(&mut across) {
                    if self.meets(points, [a, b], g) {
                        self.blocks.table[index] = u16::from(a) | u16::from(b) << 6 | place(corner) << 12;
                        return false;
                    }
                }
            }
        }
        self.reaches_all(points, w, face)
    }

    /// Whether no edge from a vertex to a corner of a face pierces a front face.
    fn reaches_all(&mut self, points: &Points, w: u8, face: Face) -> bool {
        let base = face.mask();
        for i in 0..self.front.faces.len() {
            let sides = self.front.sides[i];
            let ahead = (sides.ahead >> w & 1).wrapping_neg();
            let behind = (sides.behind >> w & 1).wrapping_neg();
            let mut across = base & (ahead & sides.behind | behind & sides.ahead);
            while let Some(v) = take_lowest(&mut across) {
                if self.meets(points, [w, v], self.front.faces[i]) {
                    return false;
                }
            }
        }
        true
    }

    /// Whether the line through two vertices on different sides of a face meets the closed face.
    fn meets(&mut self, points: &Points, [p, q]: [u8; 2], face: Face) -> bool {
        let [x, y, z] = face.corners();
        let first = self.signs.of(points, p, q, x, y);
        let second = self.signs.of(points, p, q, y, z);
        if first * second < 0 {
            return false;
        }
        let third = self.signs.of(points, p, q, z, x);
        first * third >= 0 && second * third >= 0
    }
}
