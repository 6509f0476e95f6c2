//! The orientations of all quadruples of a small set of vertices, computed when first asked for.
use super::MOST_VERTICES;
use crate::error::Error;
use crate::predicates::{Points, Sign};

const UNKNOWN: i8 = 2;

/// Signs by local vertex numbers.
#[derive(Default)]
pub struct Signs {
    /// Vertex ids, in ascending order.
    pub vertices: Vec<u32>,
    /// Per combination `i < j < k < l` its sign, or `UNKNOWN`.
    table: Vec<i8>,
}

/// `PAIRS[i]`: combinations of two numbers below `i`, and so on.
const fn choose2(i: usize) -> usize {
    i * (i.wrapping_sub(1)) / 2
}

const fn choose3(i: usize) -> usize {
    if i < 3 {
        0
    } else {
        i * (i - 1) * (i - 2) / 6
    }
}

/// Combinations of four numbers below `i`.
pub const fn choose4(i: usize) -> usize {
    if i < 4 {
        0
    } else {
        i * (i - 1) * (i - 2) * (i - 3) / 24
    }
}

/// The three tables, for the combinatorial number system: `(i < j < k < l)` has the index `i + C(j,2) + C(k,3) + C(l,4)`.
const fn tables() -> [[u32; MOST_VERTICES]; 3] {
    let mut all = [[0; MOST_VERTICES]; 3];
    let mut i = 0;
    while i < MOST_VERTICES {
        all[0][i] = if i < 2 { 0 } else { choose2(i) as u32 };
        all[1][i] = choose3(i) as u32;
        all[2][i] = choose4(i) as u32;
        i += 1;
    }
    all
}

static CHOOSE: [[u32; MOST_VERTICES]; 3] = tables();

/// The index of a quadruple of distinct numbers, the numbers in ascending order, and whether sorting them was an odd permutation.
#[inline(always)]
pub fn combination(mut v: [u8; 4]) -> (usize, [u8; 4], bool) {
    let mut odd = false;
    for (i, j) in [(0, 1), (2, 3), (0, 2), (1, 3), (1, 2)] {
        if v[i] > v[j] {
            v.swap(i, j);
            odd = !odd;
        }
    }
    let index = v[0] as usize
        + (CHOOSE[0][v[1] as usize] + CHOOSE[1][v[2] as usize] + CHOOSE[2][v[3] as usize]) as usize;
    (index, v, odd)
}

impl Signs {
    /// Takes the vertices (any order, with repetitions); false if they are too many.
    pub fn set(&mut self, vertices: impl Iterator<Item = u32>) -> Result<bool, Error> {
        self.vertices.clear();
        for v in vertices {
            self.vertices.try_reserve(1)?;
            self.vertices.push(v);
        }
        self.vertices.sort_unstable();
        self.vertices.dedup();
        let count = self.vertices.len();
        if !(4..=MOST_VERTICES).contains(&count) {
            return Ok(false);
        }
        self.table.clear();
        self.table.try_reserve(choose4(count))?;
        self.table.resize(choose4(count), UNKNOWN);
        Ok(true)
    }

    /// The local number of a vertex.
    pub fn number(&self, v: u32) -> Option<u8> {
        self.vertices.binary_search(&v).ok().map(|i| i as u8)
    }

    /// How many vertices there are.
    pub fn count(&self) -> usize {
        self.vertices.len()
    }

    /// 1, 0 or −1 for `det(b − a, c − a, d − a)`; distinct local numbers.
    #[inline]
    pub fn of(&mut self, points: &Points, a: u8, b: u8, c: u8, d: u8) -> i8 {
        let (index, v, odd) = combination([a, b, c, d]);
        let mut sign = self.table[index];
        if sign == UNKNOWN {
            let [p, q, r, s] = v.map(|i| self.vertices[i as usize]);
            sign = match points.orient3d(p, q, r, s) {
                Sign::Negative => -1,
                Sign::Zero => 0,
                Sign::Positive => 1,
            };
            self.table[index] = sign;
        }
        if odd {
            -sign
        } else {
            sign
        }
    }
}
