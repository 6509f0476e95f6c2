//! Exact signs for explicit points and for implicit Steiner points on segments and facets. The only module that calls `robust`.
//!
//! Levels: a static error bound from the box of all points, inlined; a semi-static bound from the given points; exact arithmetic in
//! integers of fixed width; if those are too narrow, `robust` for explicit points and big integers otherwise.
//!
//! Orientation: [`orient3d()`] is positive when `det(b − a, c − a, d − a) > 0`, the opposite of Shewchuk's and
//! `robust`'s sign.

mod big;
mod center;
mod exact;
mod expansion;
mod filter;
mod insphere;
mod located;
mod on_facet;
mod orient;
mod placed;
mod plane;
mod points;
mod position;
mod power;
mod range;
#[cfg(test)]
mod tests;
mod wide;

pub use expansion::Expansion;
pub(crate) use insphere::Glance;
pub use placed::Placed;
pub use points::Points;
pub use position::Position;
pub use power::{is_offset, Lifts, OFFSET_EXPONENT};
pub use range::{far_from_most, in_range, is_parameter, range_scale, scale, surviving};

/// The sign of a determinant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(i8)]
pub enum Sign {
    /// Below zero.
    Negative = -1,
    /// Exactly zero.
    Zero = 0,
    /// Above zero.
    Positive = 1,
}

impl Sign {
    /// The sign of a number (NaN counts as zero).
    #[inline(always)]
    pub fn of(value: f64) -> Sign {
        if value > 0.0 {
            Sign::Positive
        } else if value < 0.0 {
            Sign::Negative
        } else {
            Sign::Zero
        }
    }
}

impl std::ops::Neg for Sign {
    type Output = Sign;
    #[inline(always)]
    fn neg(self) -> Sign {
        match self {
            Sign::Negative => Sign::Positive,
            Sign::Zero => Sign::Zero,
            Sign::Positive => Sign::Negative,
        }
    }
}

#[inline]
fn coord3(p: &[f64; 3]) -> robust::Coord3D<f64> {
    robust::Coord3D { x: p[0], y: p[1], z: p[2] }
}

/// The differences of explicit points to the last one as integers, if they fit.
#[inline(always)]
fn differences<const N: usize>(points: [&[f64; 3]; N]) -> Option<wide::Differences<N>> {
    wide::Differences::new(&points.map(|p| p.map(|x| [x, 0.0])))
}

/// `robust`, for explicit points that span too many bits for integers of fixed width. Not inlined: callers that mostly return before would
/// pay for its large stack.
#[cold]
#[inline(never)]
fn robust_orient3d(a: &[f64; 3], b: &[f64; 3], c: &[f64; 3], d: &[f64; 3]) -> Sign {
    -Sign::of(robust::orient3d(coord3(a), coord3(b), coord3(c), coord3(d)))
}

/// Like [`robust_orient3d`].
#[cold]
#[inline(never)]
fn robust_insphere(a: &[f64; 3], b: &[f64; 3], c: &[f64; 3], d: &[f64; 3], e: &[f64; 3]) -> Sign {
    -Sign::of(robust::insphere(coord3(a), coord3(b), coord3(c), coord3(d), coord3(e)))
}

/// Sign of `det(b − a, c − a, d − a)`: positive when the tetrahedron `(a, b, c, d)` is. Points in the exact range.
#[inline]
pub fn orient3d(a: &[f64; 3], b: &[f64; 3], c: &[f64; 3], d: &[f64; 3]) -> Sign {
    let det = filter::orient3d_det(a, b, c, d);
    let spread = filter::Spread::of([a, b, c, d]);
    if det.abs() > spread.orient3d_bound() {
        return Sign::of(det);
    }
    if spread.flat() {
        return Sign::Zero;
    }
    orient3d_exact([a, b, c, d], spread.max())
}

/// The exact level; `size` bounds all differences.
#[cold]
#[inline(never)]
fn orient3d_exact([a, b, c, d]: [&[f64; 3]; 4], size: f64) -> Sign {
    if let Some(rows) = wide::short_differences([a, b, c, d], size) {
        return wide::short_orient3d(&rows);
    }
    match differences([a, b, c, d]) {
        Some(rows) => wide::orient3d(&rows),
        None => robust_orient3d(a, b, c, d),
    }
}

/// Positive when `a`, `b`, `c` make a left turn. Points in the exact range.
#[inline]
pub fn orient2d(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> Sign {
    let (left, right) = ((a[0] - c[0]) * (b[1] - c[1]), (a[1] - c[1]) * (b[0] - c[0]));
    let det = left - right;
    // 4 roundings (see `filter`) and the rounding of the bound.
    if det.abs() > 2.5 * f64::EPSILON * (left.abs() + right.abs()) + f64::MIN_POSITIVE {
        return Sign::of(det);
    }
    // In the exact range a product vanishes only with a factor, and a difference only between equal numbers.
    if left == 0.0 || right == 0.0 {
        return Sign::of(det);
    }
    orient2d_exact(a, b, c)
}

/// The exact level; neither `a` nor `b` equals `c`.
#[cold]
#[inline(never)]
fn orient2d_exact(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> Sign {
    let points = [a, b, c].map(|p| [p[0], p[1], 0.0]);
    let [pa, pb, pc] = &points;
    let size = filter::Spread::of([pa, pb, pc]).max();
    if let Some(rows) = wide::short_differences([pa, pb, pc], size) {
        return wide::short_orient2d(&rows);
    }
    if let Some(rows) = differences([pa, pb, pc]) {
        return wide::orient2d(&rows, 0, 1);
    }
    let coord = |p: [f64; 2]| robust::Coord { x: p[0], y: p[1] };
    Sign::of(robust::orient2d(coord(a), coord(b), coord(c)))
}

/// Positive when `d` is inside the circle through the counter-clockwise `a`, `b`, `c`; odd in its first three arguments.
#[inline]
pub fn incircle(a: [f64; 2], b: [f64; 2], c: [f64; 2], d: [f64; 2]) -> Sign {
    let coord = |p: [f64; 2]| robust::Coord { x: p[0], y: p[1] };
    Sign::of(robust::incircle(coord(a), coord(b), coord(c), coord(d)))
}
