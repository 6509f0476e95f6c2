//! The power test by point index, for weighted points (Edelsbrunner & Shah 1996): like insphere, with other heights of the lifted points.
//!
//! A point with weight w is lifted to `|p|² − w`, or to a height of its own. The test is positive when the lift of e lies below the
//! hyperplane through the lifts of a, b, c, d: the determinant of insphere, whose rows relative to e end in `|a − e|²`, with the difference
//! of the *offsets* added there (the offset is −w), or with that of the heights alone. Ties are broken as without weights (see `insphere`):
//! the derivative of the determinant with respect to a lift is the same.
//!
//! Offsets are at most `2^402` in magnitude, like the squares: nothing overflows. They may be as fine as doubles are, since no bound relies
//! on products of theirs: what underflows in the filter is below its smallest term, and the exact levels are integers.

use crate::elementary::power_of_two;
use crate::error::Error;
use crate::fallible;
use crate::predicates::filter::{self, larger};
use crate::predicates::{exact, wide, Glance, Points, Sign};

/// What the lifts of points have beside, or instead of, the squares of their distances from the origin.
#[derive(Debug)]
pub struct Lifts {
    offsets: Vec<f64>,
    /// Whether the squares count.
    pub(super) squares: bool,
    /// The largest difference of offsets.
    pub(super) size: f64,
    /// The static bound.
    pub(super) bound: f64,
}

/// No offset in range is larger than two to this power.
pub const OFFSET_EXPONENT: i32 = 402;

/// Whether an offset is in the exact range.
pub fn is_offset(x: f64) -> bool {
    x.abs() <= power_of_two(OFFSET_EXPONENT)
}

impl Lifts {
    /// The offsets of all points, in their order: minus their weights with `squares`, otherwise their heights. All must be in the exact
    /// range (see [`is_offset`]).
    pub fn new(offsets: Vec<f64>, squares: bool) -> Lifts {
        debug_assert!(offsets.iter().all(|&x| is_offset(x)));
        let first = offsets.first().copied().unwrap_or(0.0);
        let (low, high) = offsets.iter().fold((first, first), |(low, high), &x| (low.min(x), high.max(x)));
        Lifts { offsets, squares, size: high - low, bound: f64::INFINITY }
    }

    /// A copy.
    pub(super) fn copied(&self) -> Result<Lifts, Error> {
        Ok(Lifts { offsets: fallible::copied(&self.offsets)?, ..*self })
    }

    /// The offset of a point.
    #[inline(always)]
    pub(super) fn of(&self, i: u32) -> f64 {
        self.offsets[i as usize]
    }
}

impl Points {
    /// Lifts the points, all explicit, to other heights.
    pub fn lift(&mut self, lifts: Lifts) {
        debug_assert!(self.implicit.is_empty() && lifts.offsets.len() == self.len());
        self.lifts = Some(lifts);
        self.update_bounds();
    }

    /// Whether they are lifted to other heights than the squares of their distances from the origin.
    pub fn are_weighted(&self) -> bool {
        self.lifts.is_some()
    }

    /// Positive when the lift of `e` is below the hyperplane through the lifts of the positive tetrahedron, zero if it is on it; without
    /// weights this is insphere.
    pub fn power(&self, [a, b, c, d]: [u32; 4], e: u32) -> Sign {
        let Some(lifts) = &self.lifts else { return self.insphere(a, b, c, d, e) };
        let ids = [a, b, c, d, e];
        let det = self.power_minors(lifts, ids).1;
        if det.abs() > lifts.bound {
            return Sign::of(det);
        }
        self.power_close(lifts, det, ids)
    }

    /// [`power`](Points::power), with ties broken by the perturbation: never zero for five distinct points that are not all coplanar.
    pub fn power_perturbed(&self, tet: [u32; 4], e: u32) -> Sign {
        match self.power(tet, e) {
            Sign::Zero => {
                let [a, b, c, d] = tet;
                self.insphere_tie([a, b, c, d, e])
            }
            sign => sign,
        }
    }

    /// Like [`glance`](Points::glance), where being inside means that [`power`](Points::power) is positive.
    pub(crate) fn glance_power(&self, [a, b, c, d]: [u32; 4], e: u32) -> Glance {
        let Some(lifts) = &self.lifts else { return Glance::Unclear };
        let (sides, det) = self.power_minors(lifts, [a, b, c, d, e]);
        match det > lifts.bound {
            true => Glance::Inside,
            false => self.beyond(sides),
        }
    }

    #[inline(always)]
    fn power_minors(&self, lifts: &Lifts, ids: [u32; 5]) -> ([f64; 4], f64) {
        filter::power_minors(ids.map(|i| self.xyz(i)), ids.map(|i| lifts.of(i)), lifts.squares)
    }

    /// The semi-static filter, then the exact levels.
    #[inline(never)]
    fn power_close(&self, lifts: &Lifts, det: f64, ids: [u32; 5]) -> Sign {
        let spread = self.spread(ids, true);
        if spread.flat() {
            return Sign::Zero;
        }
        let offsets = ids.map(|i| lifts.of(i));
        let size = offsets.iter().fold(0.0, |most, &x| larger((x - offsets[4]).abs(), most));
        if det.abs() > spread.power_bound(size, lifts.squares) {
            return Sign::of(det);
        }
        let points = ids.map(|i| self.xyz(i));
        let rows = wide::short_differences(points, spread.max());
        let short = rows
            .and_then(|rows| Some((rows, wide::short_lifts(&rows, offsets, lifts.squares, spread.max())?)));
        match short {
            Some((rows, lifts)) => wide::short_power(&rows, &lifts),
            None => exact::power(points, offsets, lifts.squares),
        }
    }
}
