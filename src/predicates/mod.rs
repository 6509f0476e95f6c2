//! Exact signs. The one place that calls `robust`.
//!
//! Orientation: [`orient3d`] is positive when `det(b − a, c − a, d − a) > 0`, the opposite of Shewchuk's and `robust`'s sign.

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

/// Sign of `det(b − a, c − a, d − a)`: positive when the tetrahedron `(a, b, c, d)` is.
#[inline]
pub fn orient3d(a: &[f64; 3], b: &[f64; 3], c: &[f64; 3], d: &[f64; 3]) -> Sign {
    -Sign::of(robust::orient3d(coord3(a), coord3(b), coord3(c), coord3(d)))
}

/// Positive when `e` is inside the circumsphere of the positive tetrahedron `(a, b, c, d)`; odd in its first four arguments.
#[inline]
pub fn insphere(a: &[f64; 3], b: &[f64; 3], c: &[f64; 3], d: &[f64; 3], e: &[f64; 3]) -> Sign {
    -Sign::of(robust::insphere(coord3(a), coord3(b), coord3(c), coord3(d), coord3(e)))
}

/// Positive when `a`, `b`, `c` make a left turn.
#[inline]
pub fn orient2d(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> Sign {
    let coord = |p: [f64; 2]| robust::Coord { x: p[0], y: p[1] };
    Sign::of(robust::orient2d(coord(a), coord(b), coord(c)))
}

/// Positive when `d` is inside the circle through the counter-clockwise `a`, `b`, `c`; odd in its first three arguments.
#[inline]
pub fn incircle(a: [f64; 2], b: [f64; 2], c: [f64; 2], d: [f64; 2]) -> Sign {
    let coord = |p: [f64; 2]| robust::Coord { x: p[0], y: p[1] };
    Sign::of(robust::incircle(coord(a), coord(b), coord(c), coord(d)))
}
