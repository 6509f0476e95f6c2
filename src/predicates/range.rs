//! The range of coordinates in which all signs are exact, and scaling by powers of two into it.
//!
//! Coordinates are multiples of `2^-214`, at most `2^200` in magnitude. The insphere determinant has degree 5, so every product and every
//! rounding error in it is a multiple of `2^-1070`: above the smallest double, `2^-1074`, nothing underflows. Differences are at most
//! `2^201`, the determinant's sums below `2^1015`: nothing overflows, and no factor that is split in a product (degree at most 4, below
//! `2^815`) comes near `2^996`, where splitting would overflow.
//!
//! A Steiner point on a segment, `a + t (b − a)`, lies in the same box, but may have bits below `2^-214` (down to `2^-1014`, as t is a
//! multiple of `2^-800`: no expansion of a coordinate underflows): the store marks these, and integers decide all their
//! signs, without filters.
//!
//! A point on a facet, `o + u (a − o) + v (b − o)`, has parameters of either sign, multiples of `2^-800` as well: they have at most the 53
//! bits of a double each, but these may be anywhere from `2^-800` to `2^415`, the largest ratio of two distances on one axis (`2^201` and
//! `2^-214`). Both differences are sums of two doubles, multiples of `2^-214` of at most `2^201`. So all products, sums and rounding errors
//! in the expansion of a coordinate are multiples of `2^-1014`, and so are the parts of factors and their products when a product is split:
//! nothing underflows. Products are at most `2^616`, sums below `2^618`, and no factor that is split is above `2^415`: nothing overflows.
//! The point itself must not leave the box, which the store checks: its coordinates are then what those of points on segments are.

use crate::predicates::{Expansion, Sign};

/// All coordinates in range are multiples of two to this power.
pub(crate) const LOWEST_EXPONENT: i32 = -214;
/// No coordinate in range is larger than two to this power.
pub(crate) const HIGHEST_EXPONENT: i32 = 200;
/// The exponent to which scaling brings the largest coordinate.
const TARGET_EXPONENT: i32 = 195;

/// `|x| = mantissa 2^exponent`, the mantissa odd or zero; x finite.
pub(crate) fn decompose(x: f64) -> (u64, i32) {
    let bits = x.to_bits();
    let biased = ((bits >> 52) & 0x7ff) as i32;
    let fraction = bits & ((1 << 52) - 1);
    let (mantissa, exponent) =
        if biased == 0 { (fraction, -1074) } else { (fraction | 1 << 52, biased - 1075) };
    if mantissa == 0 {
        return (0, 0);
    }
    let zeros = mantissa.trailing_zeros();
    (mantissa >> zeros, exponent + zeros as i32)
}

/// Exponent of the lowest set bit; `None` for zero.
pub(crate) fn lowest_exponent(x: f64) -> Option<i32> {
    let (mantissa, exponent) = decompose(x);
    (mantissa != 0).then_some(exponent)
}

/// Exponent of the highest set bit; `None` for zero.
pub(crate) fn highest_exponent(x: f64) -> Option<i32> {
    let (mantissa, exponent) = decompose(x);
    (mantissa != 0).then(|| exponent + 63 - mantissa.leading_zeros() as i32)
}

/// Whether a coordinate is in the exact range.
pub fn in_range(x: f64) -> bool {
    in_box(x) && lowest_exponent(x).is_none_or(|e| e >= LOWEST_EXPONENT)
}

/// Whether a coordinate is not too large for the exact range, however fine it is.
pub(crate) fn in_box(x: f64) -> bool {
    x.is_finite() && x.abs() <= scale(1.0, HIGHEST_EXPONENT)
}

/// The nearest multiple of the unit of coordinates in range; `x` itself unless it is tiny.
pub fn to_range(x: f64) -> f64 {
    let unit = scale(1.0, LOWEST_EXPONENT);
    if x.abs() < unit * (1u64 << 53) as f64 {
        (x / unit).round() * unit
    } else {
        x
    }
}

/// The nearest number within the range of exact arithmetic that the caller's scale can represent; subnormal numbers may lose bits.
pub fn surviving(x: f64, scale_exponent: i32) -> f64 {
    scale(scale(to_range(x), -scale_exponent), scale_exponent)
}

/// All parameters of Steiner points are multiples of two to this power. Segments at an angle α need a precision of α²: this is enough down
/// to angles of `2^-390`, and doubles in range reach `2^-415`.
const LOWEST_PARAMETER_EXPONENT: i32 = -800;

/// Whether a Steiner point can have this parameter: strictly between 0 and 1, and not too fine.
pub fn is_parameter(t: &Expansion) -> bool {
    t.sign() == Sign::Positive
        && t.difference(&Expansion::from(1.0)).sign() == Sign::Negative
        && t.components().iter().all(|&x| lowest_exponent(x).is_none_or(|e| e >= LOWEST_PARAMETER_EXPONENT))
}

/// No parameter of a point on a facet is larger than two to this power.
const HIGHEST_PARAMETER_EXPONENT: i32 = HIGHEST_EXPONENT + 1 - LOWEST_EXPONENT;

/// Whether a point on a facet can have this parameter, as either of its two: neither too large nor too fine.
pub fn is_facet_parameter(x: f64) -> bool {
    x.is_finite()
        && x.abs() <= scale(1.0, HIGHEST_PARAMETER_EXPONENT)
        && lowest_exponent(x).is_none_or(|e| e >= LOWEST_PARAMETER_EXPONENT)
}

/// The exponent `k` such that all points times `2^k` are in the exact range; 0 if they already are.
///
/// # Errors
/// The index of the first point with a coordinate that is not finite, otherwise of the first one at fault (see [`far_from_most`]).
pub fn range_scale(points: &[[f64; 3]]) -> Result<i32, usize> {
    let mut highest = i32::MIN;
    let mut inside = true;
    for (i, p) in points.iter().enumerate() {
        for &x in p {
            if !x.is_finite() {
                return Err(i);
            }
            highest = highest.max(highest_exponent(x).unwrap_or(i32::MIN));
            inside &= in_range(x);
        }
    }
    // Near the upper end there would be no room for the box that mode preserve puts around the points.
    if inside && highest <= TARGET_EXPONENT {
        return Ok(0);
    }
    let k = TARGET_EXPONENT - highest;
    let fits = |x: f64| lowest_exponent(x).is_none_or(|e| e + k >= LOWEST_EXPONENT);
    match points.iter().position(|p| !p.iter().all(|&x| fits(x))) {
        Some(_) if inside => Ok(0),
        Some(i) => Err(far_from_most(points).next().unwrap_or(i)),
        None => Ok(k),
    }
}

/// The points at fault if a set spans too many orders of magnitude: those outside the range that contains the most points. (In a model with
/// one point far away, this is that point; the tiny bits of the others are not at fault.) Coordinates must be finite.
pub fn far_from_most(points: &[[f64; 3]]) -> impl Iterator<Item = usize> + '_ {
    /// From the lowest bit in range to the highest.
    const SPAN: i32 = TARGET_EXPONENT - LOWEST_EXPONENT;
    /// The lowest exponent at which ranges begin.
    const FIRST: i32 = -1074 - SPAN;
    const COUNT: usize = (1024 - FIRST) as usize;
    // The ranges that contain a point begin in an interval, which may be empty.
    let starts = |p: &[f64; 3]| {
        let lowest = p.iter().filter_map(|&x| lowest_exponent(x)).min().unwrap_or(1023);
        let highest = p.iter().filter_map(|&x| highest_exponent(x)).max().unwrap_or(-1074);
        (highest - SPAN).max(FIRST)..=lowest
    };
    let mut change = [0i64; COUNT + 1];
    for range in points.iter().map(starts).filter(|range| !range.is_empty()) {
        change[(range.start() - FIRST) as usize] += 1;
        change[(range.end() - FIRST) as usize + 1] -= 1;
    }
    let (mut held, mut best) = (0, (0, FIRST));
    for (start, change) in (FIRST..).zip(change) {
        held += change;
        if held >= best.0 {
            best = (held, start);
        }
    }
    (0..points.len()).filter(move |&i| !starts(&points[i]).contains(&best.1))
}

/// `x 2^k`, rounded once; exact if the result is a double, including subnormal ones.
pub fn scale(x: f64, k: i32) -> f64 {
    let power = |k: i32| f64::from_bits(((k + 1023) as u64) << 52);
    // Steps down leave 53 bits of room, so that only the last one may round.
    let (mut x, mut k) = (x, k.clamp(-3000, 3000));
    while k > 1023 {
        x *= power(1023);
        k -= 1023;
    }
    while k < -1022 {
        x *= power(-969);
        k += 969;
    }
    x * power(k)
}
