//! Expansion arithmetic: exact sums and products as unevaluated sums of doubles.
//!
//! Invariant of an [`Expansion`]: its components are non-zero, strongly non-overlapping, and of increasing magnitude; zero has no
//! components. All operations maintain it (with round to nearest even). They are exact as long as nothing over- or underflows, which the
//! range of coordinates rules out (see `range`). Used for the coordinates of Steiner points, their rounding and their order; determinants
//! are evaluated in integers (see `wide`). Source: Shewchuk, *Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
//! Predicates*, 1997, sections 2.3 to 2.8.

use crate::predicates::Sign;

/// `a + b` as rounded sum and exact error (Knuth).
#[inline(always)]
pub(crate) fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let x = a + b;
    let b_virtual = x - a;
    let a_virtual = x - b_virtual;
    (x, (a - a_virtual) + (b - b_virtual))
}

/// Like [`two_sum`], for `|a| >= |b|` or zero `a` (Dekker).
#[inline(always)]
pub(crate) fn fast_two_sum(a: f64, b: f64) -> (f64, f64) {
    let x = a + b;
    (x, b - (x - a))
}

#[inline(always)]
fn split(a: f64) -> (f64, f64) {
    const SPLITTER: f64 = 134_217_729.0; // 2^27 + 1
    let c = SPLITTER * a;
    let high = c - (c - a);
    (high, a - high)
}

/// `a b` as rounded product and exact error (Dekker, Veltkamp; no fused multiplication).
#[inline(always)]
pub(crate) fn two_product(a: f64, b: f64) -> (f64, f64) {
    let x = a * b;
    let (ah, al) = split(a);
    let (bh, bl) = split(b);
    (x, al * bl - (((x - ah * bh) - al * bh) - ah * bl))
}

/// Components that fit without the heap. Coordinates of Steiner points have 1 to 5.
const INLINE: usize = 8;

/// An exact number: the sum of its components.
#[derive(Clone, Debug)]
pub struct Expansion {
    len: usize,
    inline: [f64; INLINE],
    /// Holds all components once there are more than fit inline.
    heap: Vec<f64>,
}

impl Default for Expansion {
    fn default() -> Self {
        Expansion::zero()
    }
}

impl From<f64> for Expansion {
    fn from(value: f64) -> Self {
        let mut e = Expansion::zero();
        e.push(value);
        e
    }
}

impl Expansion {
    /// Zero: no components.
    #[inline]
    pub fn zero() -> Self {
        Expansion { len: 0, inline: [0.0; INLINE], heap: Vec::new() }
    }

    /// The exact difference `a − b` of two doubles.
    pub fn of_difference(a: f64, b: f64) -> Self {
        let (x, y) = two_sum(a, -b);
        let mut e = Expansion::zero();
        e.push(y);
        e.push(x);
        e
    }

    /// The components, smallest first; none for zero.
    #[inline]
    pub fn components(&self) -> &[f64] {
        if self.heap.is_empty() {
            &self.inline[..self.len]
        } else {
            &self.heap
        }
    }

    #[inline]
    fn components_mut(&mut self) -> &mut [f64] {
        if self.heap.is_empty() {
            &mut self.inline[..self.len]
        } else {
            &mut self.heap
        }
    }

    /// Appends a component larger than all before; zero is dropped.
    #[inline]
    fn push(&mut self, value: f64) {
        if value == 0.0 {
            return;
        }
        if self.len < INLINE {
            self.inline[self.len] = value;
        } else {
            if self.heap.is_empty() {
                self.heap.extend_from_slice(&self.inline);
            }
            self.heap.push(value);
        }
        self.len += 1;
    }

    fn truncate(&mut self, len: usize) {
        if len <= INLINE && !self.heap.is_empty() {
            self.inline[..len].copy_from_slice(&self.heap[..len]);
            self.heap = Vec::new();
        }
        self.heap.truncate(len);
        self.len = len;
    }

    /// The sign of the exact value: that of the largest component.
    #[inline]
    pub fn sign(&self) -> Sign {
        self.components().last().map_or(Sign::Zero, |&x| Sign::of(x))
    }

    /// A double within an ulp of the value.
    pub fn approximate(&self) -> f64 {
        self.components().iter().sum()
    }

    /// The double nearest to the exact value, ties to even.
    pub fn nearest(&self) -> f64 {
        // Sum from the largest down until something is rounded off; then only a tie that the rest breaks remains to be corrected (as in
        // Python's math.fsum).
        let e = self.components();
        let Some((&last, mut rest)) = e.split_last() else {
            return 0.0;
        };
        let (mut high, mut low) = (last, 0.0);
        while let Some((&next, lower)) = rest.split_last() {
            rest = lower;
            (high, low) = fast_two_sum(high, next);
            if low != 0.0 {
                break;
            }
        }
        if let Some(&next) = rest.last() {
            if (low < 0.0 && next < 0.0) || (low > 0.0 && next > 0.0) {
                let twice = low * 2.0;
                let other = high + twice;
                if other - high == twice {
                    high = other;
                }
            }
        }
        high
    }

    /// The sum (FAST-EXPANSION-SUM with zero elimination).
    pub fn sum(&self, other: &Expansion) -> Expansion {
        self.combine(other, 1.0)
    }

    /// `self − other`.
    pub fn difference(&self, other: &Expansion) -> Expansion {
        self.combine(other, -1.0)
    }

    /// `self + factor other`, factor 1 or −1.
    fn combine(&self, other: &Expansion, factor: f64) -> Expansion {
        let (e, f) = (self.components(), other.components());
        let (mut i, mut j) = (0, 0);
        let mut next = || {
            if j == f.len() || (i < e.len() && e[i].abs() <= f[j].abs()) {
                i += 1;
                e[i - 1]
            } else {
                j += 1;
                factor * f[j - 1]
            }
        };
        let mut out = Expansion::zero();
        let count = e.len() + f.len();
        if count == 0 {
            return out;
        }
        let mut q = next();
        for _ in 1..count {
            let (high, low) = two_sum(q, next());
            out.push(low);
            q = high;
        }
        out.push(q);
        out
    }

    /// The product with a double (SCALE-EXPANSION with zero elimination).
    pub fn scale(&self, b: f64) -> Expansion {
        let mut out = Expansion::zero();
        let Some((&first, rest)) = self.components().split_first() else {
            return out;
        };
        let (mut q, low) = two_product(first, b);
        out.push(low);
        for &e in rest {
            let (high, low) = two_product(e, b);
            let (sum, error) = two_sum(q, low);
            out.push(error);
            let (x, y) = fast_two_sum(high, sum);
            out.push(y);
            q = x;
        }
        out.push(q);
        out
    }

    /// The product of two expansions, compressed.
    pub fn product(&self, other: &Expansion) -> Expansion {
        let (long, short) = if self.len >= other.len { (self, other) } else { (other, self) };
        let mut out = Expansion::zero();
        for &f in short.components() {
            let term = long.scale(f);
            out = if out.len == 0 { term } else { out.sum(&term) };
        }
        out.compressed()
    }

    /// The same value in as few components as doubles allow (COMPRESS); the largest is within an ulp of the value.
    pub fn compressed(mut self) -> Expansion {
        let m = self.len;
        if m < 2 {
            return self;
        }
        let e = self.components_mut();
        let mut bottom = m - 1;
        let mut q = e[bottom];
        for i in (0..m - 1).rev() {
            let (high, low) = fast_two_sum(q, e[i]);
            q = high;
            if low != 0.0 {
                e[bottom] = q;
                bottom -= 1;
                q = low;
            }
        }
        e[bottom] = q;
        let mut top = 0;
        for i in bottom + 1..m {
            let (high, low) = fast_two_sum(e[i], q);
            q = high;
            if low != 0.0 {
                e[top] = low;
                top += 1;
            }
        }
        if q != 0.0 {
            e[top] = q;
            top += 1;
        }
        self.truncate(top);
        self
    }
}
