//! Positions of points: doubles, or exact combinations of explicit points that doubles cannot represent.
//!
//! Invariants: the points that a position refers to are explicit; the parameters are in the range that keeps all coordinates exact (see
//! `range`). No position has a denominator, so each coordinate is an exact expansion: two doubles in nearly all cases, and one where
//! the points lie on a common grid. Few bits in the parameters keep it short.
//!
//! Source: implicit points as in Diazzi, Panozzo, Vaxman & Attene 2023, but with doubles as parameters instead of intersections. Shewchuk &
//! Si 2014 put points on segments and facets of a constrained Delaunay tetrahedralization; where on them is free within a region.

use crate::error::Error;
use crate::fallible;
use crate::predicates::expansion::{two_product, two_sum, Expansion, OfFacet, Short, Sum};
use crate::predicates::range;

/// Where a point lies.
#[derive(Debug)]
pub enum Position {
    /// At its doubles.
    Explicit,
    /// On a segment, at `a + t (b − a)`.
    OnSegment {
        /// Where the segment begins.
        a: u32,
        /// Where it ends.
        b: u32,
        /// Between 0 and 1.
        t: Parameter,
    },
    /// On a facet, at `o + u (a − o) + v (b − o)`.
    OnFacet {
        /// The origin of the facet's frame: three points of its plane that are not collinear.
        o: u32,
        /// The end of the first axis.
        a: u32,
        /// The end of the second axis.
        b: u32,
        /// In units of the first axis; any number in range, of either sign.
        u: f64,
        /// In units of the second axis.
        v: f64,
    },
}

impl Position {
    pub(super) fn copied(&self) -> Result<Position, Error> {
        Ok(match self {
            Position::Explicit => Position::Explicit,
            Position::OnSegment { a, b, t } => Position::OnSegment { a: *a, b: *b, t: t.copied()? },
            &Position::OnFacet { o, a, b, u, v } => Position::OnFacet { o, a, b, u, v },
        })
    }
}

/// A parameter on a segment: a double, or the sum of several if segments run so close to each other that one is too coarse.
#[derive(Debug)]
pub struct Parameter {
    nearest: f64,
    /// The components beyond the nearest double, smallest first. Usually empty.
    low: Vec<f64>,
}

impl Parameter {
    pub(super) fn new(t: &Expansion) -> Result<Parameter, Error> {
        let nearest = t.nearest();
        let low = match t.components() {
            [_] => Vec::new(),
            _ => fallible::copied(t.difference(&Expansion::from(nearest)).compressed().components())?,
        };
        Ok(Parameter { nearest, low })
    }

    fn copied(&self) -> Result<Parameter, Error> {
        Ok(Parameter { nearest: self.nearest, low: fallible::copied(&self.low)? })
    }

    /// The parameter if it is one double.
    pub(super) fn one(&self) -> Option<f64> {
        self.low.is_empty().then_some(self.nearest)
    }

    /// The exact parameter.
    pub fn value(&self) -> Expansion {
        if self.low.is_empty() {
            return Expansion::from(self.nearest);
        }
        self.low.iter().fold(Expansion::from(self.nearest), |sum, &x| sum.sum(&Expansion::from(x)))
    }
}

/// What lies beyond the nearest doubles of a position.
#[derive(Clone, Copy, Debug)]
pub(super) struct Beyond {
    /// The nearest doubles of `exact − nearest double`.
    pub(super) rest: [f64; 3],
    /// Whether the nearest double plus `rest` is exact in all coordinates.
    pub(super) two_doubles: bool,
    /// Whether a coordinate has bits below the exact range: filters could underflow.
    pub(super) fine: bool,
}

/// The nearest doubles of exact coordinates, and what lies beyond them; `None` if they are the coordinates and in the exact range.
pub(super) fn round<const ROOM: usize>(exact: &[Sum<ROOM>; 3]) -> ([f64; 3], Option<Beyond>) {
    let lowest = exact.iter().filter_map(|e| range::lowest_exponent(*e.components().first()?)).min();
    let fine = lowest.is_some_and(|e| e < range::LOWEST_EXPONENT);
    let nearest = [0, 1, 2].map(|i| exact[i].nearest());
    if !fine && exact.iter().all(|e| e.components().len() <= 1) {
        return (nearest, None);
    }
    let beyond = [0, 1, 2].map(|i| exact[i].difference(&Sum::from(nearest[i])).compressed());
    let two_doubles = beyond.iter().all(|e| e.components().len() <= 1);
    let rest = [0, 1, 2].map(|i| beyond[i].nearest());
    (nearest, Some(Beyond { rest, two_doubles, fine }))
}

/// The exact `a + t (b − a)`.
pub(super) fn on_segment<const ROOM: usize>([a, b]: [&[f64; 3]; 2], t: &Sum<ROOM>) -> [Sum<ROOM>; 3] {
    [0, 1, 2].map(|i| {
        let d = Sum::of_difference(b[i], a[i]);
        let along = if let [t] = t.components() { d.scale(*t) } else { d.product(t) };
        along.sum(&Sum::from(a[i])).compressed()
    })
}

/// The exact `o + u (a − o) + v (b − o)`.
pub(super) fn on_facet([o, a, b]: [&[f64; 3]; 3], [u, v]: [f64; 2]) -> [OfFacet; 3] {
    [0, 1, 2].map(|i| {
        let first = OfFacet::of_difference(a[i], o[i]).scale(u);
        let second = OfFacet::of_difference(b[i], o[i]).scale(v);
        first.sum(&second).sum(&OfFacet::from(o[i])).compressed()
    })
}

/// Approximate square of the distance between `a + t (b − a)` and its nearest double point; hardly ever zero unless the point is
/// exactly a double. Twice the precision of doubles suffices for comparing candidates.
pub(super) fn rounding_error(a: &[f64; 3], b: &[f64; 3], t: f64) -> f64 {
    let error = |axis: usize| {
        let (high, low) = two_sum(b[axis], -a[axis]);
        let (product, rest) = two_product(high, t);
        let (sum, beyond) = two_sum(a[axis], product);
        let rest = beyond + (rest + low * t);
        rest - ((sum + rest) - sum)
    };
    (0..3).map(|axis| error(axis) * error(axis)).sum()
}

/// The largest `n <= 52` such that the coordinate `a + t (b − a)` is exactly a double for every `t = k / 2^n`; 0 if there is none.
///
/// Let d = b − a and g = 2^(low(d) − n), low the exponent of the lowest set bit. Even k belong to smaller n. For odd k and
/// low(d) − n < low(a) the lowest bit of v = a + k d / 2^n is g exactly, so v is a double if and only if |v| <= 2^53 g;
/// |v| is largest at k = 1 or k = 2^n − 1. Otherwise all v are multiples of 2^min(low(a), low(b)) no larger than the
/// ends, and so doubles. Hence all points up to level n are doubles if the two outermost points of every level up to n are. |a|, |b| <=
/// 2^53 g is sufficient; beyond that, test level by level.
pub(super) fn exact_bits(a: f64, b: f64) -> u32 {
    const MOST: u32 = 52;
    let d = Short::of_difference(b, a);
    let Some(low) = d.components().first().and_then(|&x| range::lowest_exponent(x)) else {
        return MOST;
    };
    let high = range::highest_exponent(a).max(range::highest_exponent(b)).unwrap_or(low);
    // |a|, |b| < 2^(high + 1) <= 2^53 g.
    let mut n = (low + 52 - high).clamp(0, MOST as i32) as u32;
    let is_double =
        |from: f64, step: f64| d.scale(step).sum(&Short::from(from)).compressed().components().len() <= 1;
    while n < MOST {
        let step = range::scale(1.0, -(n as i32) - 1);
        if !is_double(a, step) || !is_double(b, -step) {
            break;
        }
        n += 1;
    }
    n
}
