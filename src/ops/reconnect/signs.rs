//! The orientations of all quadruples of a small set of vertices, computed on demand.
//!
//! Vertices may be added while the table is in use: the combinatorial number system orders quadruples by their largest number first, so new
//! ones come after all existing ones.
use crate::error::Error;
use crate::fallible;
use crate::ops::reconnect::MOST_VERTICES;
use crate::predicates::{Points, Sign};

const UNKNOWN: i8 = 2;

/// Buckets of the hash from ids to local numbers: a power of two, at least four times as many as vertices.
const BUCKETS: usize = 256;

/// Signs by local vertex numbers.
pub struct Signs {
    /// Vertex ids by local number, in the order of their addition.
    pub vertices: Vec<u32>,
    /// Coordinates by local number.
    pub xyz: Vec<[f64; 3]>,
    /// Local numbers plus one, or zero if there is none; open addressing.
    buckets: [u8; BUCKETS],
    /// For each combination `i < j < k < l` its sign, or `UNKNOWN`.
    table: Vec<i8>,
}

impl Default for Signs {
    fn default() -> Self {
        Signs { vertices: Vec::new(), xyz: Vec::new(), buckets: [0; BUCKETS], table: Vec::new() }
    }
}

/// `PAIRS[i]`: combinations of two numbers below `i`, and so on.
const fn choose2(i: usize) -> usize {
    i * (i.wrapping_sub(1)) / 2
}

/// Combinations of three numbers below `i`.
pub const fn choose3(i: usize) -> usize {
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

/// The index of a triple of distinct numbers, in any order.
#[inline(always)]
pub fn triple([x, y, z]: [u8; 3]) -> usize {
    let (low, high) = (x.min(y), x.max(y));
    let (middle, high) = (high.min(z), high.max(z));
    let (low, middle) = (low.min(middle), low.max(middle));
    low as usize + (CHOOSE[0][middle as usize] + CHOOSE[1][high as usize]) as usize
}

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
    /// Forgets all vertices and signs.
    pub fn clear(&mut self) {
        self.vertices.clear();
        self.xyz.clear();
        self.buckets = [0; BUCKETS];
        self.table.clear();
    }

    /// The bucket of a vertex, or the empty one where it belongs.
    fn bucket(&self, v: u32) -> usize {
        let mut at = (v.wrapping_mul(0x9e37_79b9) >> 24) as usize;
        loop {
            match self.buckets[at] {
                0 => return at,
                n if self.vertices[n as usize - 1] == v => return at,
                _ => at = (at + 1) % BUCKETS,
            }
        }
    }

    /// The local number of a vertex, which is added if it is new; `None` if there are too many.
    pub fn add(&mut self, points: &Points, v: u32) -> Result<Option<u8>, Error> {
        let at = self.bucket(v);
        if self.buckets[at] > 0 {
            return Ok(Some(self.buckets[at] - 1));
        }
        let count = self.vertices.len();
        if count == MOST_VERTICES {
            return Ok(None);
        }
        let room = choose4(count + 1);
        fallible::resize(&mut self.table, room, UNKNOWN)?;
        fallible::push(&mut self.vertices, v)?;
        fallible::push(&mut self.xyz, *points.xyz(v))?;
        self.buckets[at] = count as u8 + 1;
        Ok(Some(count as u8))
    }

    /// The local number of a vertex, if it was added.
    pub fn number(&self, v: u32) -> Option<u8> {
        self.buckets[self.bucket(v)].checked_sub(1)
    }

    /// The number of vertices.
    pub fn count(&self) -> usize {
        self.vertices.len()
    }

    /// 1, 0 or −1 for `det(b − a, c − a, d − a)`; distinct local numbers.
    #[inline]
    pub fn of(&mut self, points: &Points, a: u8, b: u8, c: u8, d: u8) -> i8 {
        let (index, sorted, odd) = combination([a, b, c, d]);
        let mut sign = self.table[index];
        if sign == UNKNOWN {
            sign = self.compute(points, index, sorted);
        }
        // Negated if all bits of the mask are set.
        let mask = -i8::from(odd);
        (sign ^ mask) - mask
    }

    #[inline(never)]
    fn compute(&mut self, points: &Points, index: usize, sorted: [u8; 4]) -> i8 {
        let [p, q, r, s] = sorted.map(|i| self.vertices[i as usize]);
        let sign = match points.orient3d(p, q, r, s) {
            Sign::Negative => -1,
            Sign::Zero => 0,
            Sign::Positive => 1,
        };
        self.table[index] = sign;
        sign
    }
}
