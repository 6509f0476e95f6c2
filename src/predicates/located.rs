//! Points as the signs see them: the nearest doubles, and what lies beyond these.
//!
//! The bounds of the filters and the integers of the exact level come from here. They depend on what lies beyond the doubles, not on the
//! kind of position: a point on a facet takes the same way to its sign as one on a segment.

use crate::error::Error;
use crate::predicates::filter::{larger, Spread};
use crate::predicates::position::{Beyond, Position};
use crate::predicates::wide::Differences;
use crate::predicates::{range, wide, Sign};

/// A point that doubles cannot represent.
#[derive(Debug)]
pub(super) struct Implicit {
    pub(super) position: Position,
    pub(super) beyond: Beyond,
}

impl Implicit {
    pub(super) fn copied(&self) -> Result<Implicit, Error> {
        Ok(Implicit { position: self.position.copied()?, beyond: self.beyond })
    }
}

/// A point, in the store or not.
#[derive(Clone, Copy)]
pub(super) struct Located<'a> {
    /// The coordinates, or the nearest doubles if it is implicit.
    pub(super) xyz: &'a [f64; 3],
    pub(super) implicit: Option<&'a Implicit>,
}

impl Located<'_> {
    fn rest(&self) -> [f64; 3] {
        self.implicit.map_or([0.0; 3], |p| p.beyond.rest)
    }

    /// Whether it needs big integers.
    #[inline(always)]
    pub(super) fn fine(&self) -> bool {
        self.implicit.is_some_and(|p| p.beyond.fine)
    }

    /// The difference `self − from`, rounded a few times.
    pub(super) fn minus(&self, from: &Located, axis: usize) -> f64 {
        (self.xyz[axis] - from.xyz[axis]) + (self.rest()[axis] - from.rest()[axis])
    }
}

/// Adds what lies beyond the doubles to bounds on the differences of their doubles to the last one's.
#[inline(always)]
pub(super) fn widen<const N: usize>(spread: &mut Spread, points: &[Located; N]) {
    // The rest is rounded itself.
    let bound = |x: f64| x.abs() * (1.0 + 2.0 * f64::EPSILON);
    let of = |p: &Located| p.rest().map(bound);
    for p in &points[..N - 1] {
        for (worst, e) in spread.error.iter_mut().zip(of(p)) {
            *worst = larger(*worst, e);
        }
    }
    for (axis, e) in of(&points[N - 1]).into_iter().enumerate() {
        spread.error[axis] += e;
        spread.size[axis] += spread.error[axis];
    }
}

/// The differences of these points to the last one as integers, if they fit.
#[inline(always)]
pub(super) fn differences<const N: usize>(points: &[Located; N]) -> Option<Differences<N>> {
    let mut coordinates = [[[0.0; 2]; 3]; N];
    for (to, p) in coordinates.iter_mut().zip(points) {
        let rest = match p.implicit {
            None => [0.0; 3],
            Some(implicit) if implicit.beyond.two_doubles => implicit.beyond.rest,
            Some(_) => return None,
        };
        for axis in 0..3 {
            to[axis] = [p.xyz[axis], rest[axis]];
        }
    }
    Differences::new(&coordinates)
}

/// The insphere sign from the leading bits of the differences, if they decide.
pub(super) fn insphere_leading(points: &[Located; 5]) -> Option<Sign> {
    let mut coordinates = [[[0.0; 2]; 3]; 5];
    let mut lost = 0.0f64;
    for (to, p) in coordinates.iter_mut().zip(points) {
        let rest = p.rest();
        let rounded = p.implicit.is_some_and(|implicit| !implicit.beyond.two_doubles);
        for axis in 0..3 {
            to[axis] = [p.xyz[axis], rest[axis]];
            if rounded {
                // Rounded to nearest; the smallest double where that underflows.
                lost = lost.max(rest[axis].abs() * f64::EPSILON + range::scale(1.0, -1074));
            }
        }
    }
    wide::insphere_leading(&coordinates, lost)
}
