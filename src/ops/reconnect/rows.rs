//! The sides of faces: for each three vertices, the side of their plane on which each other vertex is. A row of the table of signs, so to
//! speak; rows are computed on demand, and completed when vertices have been added.
use crate::error::Error;
use crate::fallible;
use crate::ops::reconnect::face::{Face, Sides};
use crate::ops::reconnect::signs::{choose3, triple, Signs};
use crate::ops::reconnect::MOST_VERTICES;
use crate::predicates::{Points, Sign};

/// One row.
#[derive(Clone, Copy, Default)]
struct Row {
    /// The sides for the corners in ascending order.
    sides: Sides,
    /// The vertices whose side is known.
    known: u64,
}

/// All rows, kept until they are forgotten.
#[derive(Default)]
pub struct Rows {
    /// For each combination of three its row plus one, or zero.
    slots: Vec<u16>,
    rows: Vec<Row>,
}

// A slot has room for every row.
const _: () = assert!(choose3(MOST_VERTICES) < u16::MAX as usize);

impl Rows {
    /// Forgets all rows.
    pub fn clear(&mut self) {
        self.slots.clear();
        self.rows.clear();
    }

    /// Makes room for the rows of `count` vertices.
    pub fn set_count(&mut self, count: usize) -> Result<(), Error> {
        let most = choose3(count);
        if self.slots.len() < most {
            fallible::resize(&mut self.slots, most, 0)?;
            self.rows.try_reserve(most - self.rows.len())?;
        }
        Ok(())
    }

    /// The sides of a face on which the vertices `asked` (and possibly others) are.
    #[inline]
    #[expect(clippy::disallowed_methods, reason = "there is room for all rows")]
    pub fn of(&mut self, points: &Points, signs: &mut Signs, face: Face, asked: u64) -> Sides {
        let corners = face.corners();
        let slot = &mut self.slots[triple(corners)];
        if *slot == 0 {
            self.rows.push(Row { known: face.mask(), ..Row::default() });
            *slot = self.rows.len() as u16;
        }
        let row = &mut self.rows[*slot as usize - 1];
        let [x, y, z] = corners;
        let odd = (x > y) ^ (y > z) ^ (x > z);
        if asked & !row.known != 0 {
            let new = compute(points, signs, corners, asked & !row.known);
            let new = if odd { new.reversed() } else { new };
            row.sides.ahead |= new.ahead;
            row.sides.behind |= new.behind;
            row.known |= asked;
        }
        if odd {
            row.sides.reversed()
        } else {
            row.sides
        }
    }
}

/// The sides on which the vertices of a set, none of them a corner, are.
#[inline(never)]
fn compute(points: &Points, signs: &mut Signs, corners: [u8; 3], set: u64) -> Sides {
    let [b, c, d] = corners.map(|i| signs.vertices[i as usize]);
    let plane = points.plane(b, c, d);
    let mut sides = Sides::default();
    let mut close = 0u64;
    let mut rest = set;
    while rest != 0 {
        let w = rest.trailing_zeros();
        rest &= rest - 1;
        match plane.side(&signs.xyz[w as usize]) {
            Some(side) => {
                sides.ahead |= u64::from(side == Sign::Positive) << w;
                sides.behind |= u64::from(side == Sign::Negative) << w;
            }
            None => close |= 1 << w,
        }
    }
    let [x, y, z] = corners;
    while close != 0 {
        let w = close.trailing_zeros();
        close &= close - 1;
        let sign = signs.of(points, w as u8, x, y, z);
        sides.ahead |= u64::from(sign > 0) << w;
        sides.behind |= u64::from(sign < 0) << w;
    }
    sides
}
