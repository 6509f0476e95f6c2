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

/// Components of an [`Expansion`]: enough for the sum of any two that are compressed, and for the product of one with a double. (Doubles
/// have bits from `2^-1074` to `2^1023`, so 41 components that each cover 53 of them are the most.)
const MOST: usize = 128;

/// Components of a [`Short`] expansion. Coordinates of points on segments have 1 to 5 if the parameter is one double: the difference of the
/// ends has 2, its product with the parameter 4, and one end is added. One more is needed to subtract the nearest double.
const FEW: usize = 8;

/// Components of an [`OfFacet`] expansion. Coordinates of points on facets have 1 to 9, 1 or 2 if the parameters have few bits: the
/// differences to the origin have 2, their products with the parameters 4 each, the sum of these 8, and the origin is added. One more is
/// needed to subtract the nearest double.
const PLANAR: usize = 10;

/// An exact number: the sum of its components. They are on the stack, so that no sign can fail for want of memory.
#[derive(Clone, Copy, Debug)]
pub struct Sum<const ROOM: usize> {
    len: usize,
    all: [f64; ROOM],
}

/// An exact number of any length.
pub type Expansion = Sum<MOST>;

/// An exact number known to be short, which takes less time to make.
pub(super) type Short = Sum<FEW>;

/// A coordinate of a point on a facet.
pub(super) type OfFacet = Sum<PLANAR>;

impl<const ROOM: usize> Default for Sum<ROOM> {
    fn default() -> Self {
        Sum::zero()
    }
}

impl<const ROOM: usize> From<f64> for Sum<ROOM> {
    fn from(value: f64) -> Self {
        let mut e = Sum::zero();
        e.push(value);
        e
    }
}

impl<const ROOM: usize> Sum<ROOM> {
    /// Zero: no components.
    #[inline]
    pub fn zero() -> Self {
        Sum { len: 0, all: [0.0; ROOM] }
    }

    /// The exact difference `a − b` of two doubles.
    pub fn of_difference(a: f64, b: f64) -> Self {
        let (x, y) = two_sum(a, -b);
        let mut e = Sum::zero();
        e.push(y);
        e.push(x);
        e
    }

    /// The components, smallest first; none for zero.
    #[inline]
    pub fn components(&self) -> &[f64] {
        &self.all[..self.len]
    }

    /// The same number with room for more components.
    pub(super) fn widened(&self) -> Expansion {
        const { assert!(ROOM <= MOST) };
        let mut e = Expansion { len: self.len, all: [0.0; MOST] };
        e.all[..self.len].copy_from_slice(self.components());
        e
    }

    /// The same number in less room, if it fits.
    pub(super) fn shortened(&self) -> Option<Short> {
        let mut e = Short { len: self.len, all: [0.0; FEW] };
        e.all.get_mut(..self.len)?.copy_from_slice(self.components());
        Some(e)
    }

    /// Appends a component larger than all before; zero is dropped.
    #[inline]
    fn push(&mut self, value: f64) {
        if value != 0.0 {
            self.all[self.len] = value;
            self.len += 1;
        }
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
    pub fn sum(&self, other: &Self) -> Self {
        self.combine(other, 1.0)
    }

    /// `self − other`.
    pub fn difference(&self, other: &Self) -> Self {
        self.combine(other, -1.0)
    }

    /// `self + factor other`, factor 1 or −1.
    fn combine(&self, other: &Self, factor: f64) -> Self {
        let compressed;
        let (e, f) = if self.len + other.len <= ROOM {
            (self.components(), other.components())
        } else {
            compressed = [self.compressed(), other.compressed()];
            (compressed[0].components(), compressed[1].components())
        };
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
        let mut out = Sum::zero();
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
    pub fn scale(&self, b: f64) -> Self {
        let mut out = Sum::zero();
        let compressed;
        let e = if 2 * self.len <= ROOM {
            self.components()
        } else {
            compressed = self.compressed();
            compressed.components()
        };
        let Some((&first, rest)) = e.split_first() else {
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
    pub fn product(&self, other: &Self) -> Self {
        let (long, short) = if self.len >= other.len { (self, other) } else { (other, self) };
        let mut out = Sum::zero();
        for &f in short.components() {
            let term = long.scale(f);
            out = if out.len == 0 { term } else { out.sum(&term) };
        }
        out.compressed()
    }

    /// The same value in as few components as doubles allow (COMPRESS); the largest is within an ulp of the value.
    #[must_use]
    pub fn compressed(mut self) -> Self {
        let m = self.len;
        if m < 2 {
            return self;
        }
        let e = &mut self.all;
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
        self.len = top;
        self
    }
}
