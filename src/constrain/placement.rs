//! Where to split a missing subsegment: the three rules of Si & Gärtner 2011, section 5, with shared radii.
//!
//! Any parameter strictly inside the subsegment gives a valid mesh; only the number of Steiner points is at stake. So
//! lengths and angles are approximate here, and the parameter is rounded to bits that make the point an exact double
//! where that is possible (engine notes §4).
use crate::predicates::Points;

/// A piece of a segment: vertices and parameters of its ends.
#[derive(Clone, Copy, Debug)]
pub struct Subsegment {
    /// The segment it is a piece of.
    pub segment: u32,
    /// The ends, in the segment's direction.
    pub ends: [u32; 2],
    /// Parameters of the ends.
    pub t: [f64; 2],
}

/// Nearest and farthest admissible position within a subsegment, as fractions of its length.
const NEAR: f64 = 0.2;
/// See [`NEAR`].
const FAR: f64 = 0.8;

/// Length of the vector from `a` to `b`.
pub fn distance(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    let d = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
    (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt()
}

/// What is known of the segment that is split.
pub struct Context {
    /// The input ends.
    pub ends: [u32; 2],
    /// The ends are acute vertices (two segments meet there at less than 90°).
    pub acute: [bool; 2],
    /// The vertex of the reference point's own segment that is an end of this one too.
    pub shared: Option<usize>,
}

/// The parameter at which to split `sub`, seen from reference vertex `reference`.
pub fn choose(points: &Points, sub: &Subsegment, context: &Context, reference: Option<u32>) -> f64 {
    let [t0, t1] = sub.t;
    let length = distance(points.xyz(context.ends[0]), points.xyz(context.ends[1]));
    let inside = |t: f64| t >= t0 + NEAR * (t1 - t0) && t <= t0 + FAR * (t1 - t0);
    let sphere = |end: usize, radius: f64| {
        let t = radius / length;
        if end == 0 {
            t
        } else {
            1.0 - t
        }
    };
    let middle = t0 + 0.5 * (t1 - t0);
    let Some(reference) = reference else { return middle };
    let p = points.xyz(reference);
    // A point on a segment with a common end: the same sphere round that end.
    if let Some(end) = context.shared {
        let t = sphere(end, distance(points.xyz(context.ends[end]), p));
        if inside(t) {
            return t;
        }
    }
    match context.acute {
        [true, true] | [false, false] => {
            // Rule 1, or both ends acute: from the nearer end.
            let radii = [distance(points.xyz(sub.ends[0]), p), distance(points.xyz(sub.ends[1]), p)];
            let span = (t1 - t0) * length;
            if context.acute[0] && sub.t != [0.0, 1.0] {
                // A piece of a segment that was split before: round the acute end it is nearer to.
                let end = if t0 + t1 < 1.0 { 0 } else { 1 };
                let t = sphere(end, distance(points.xyz(context.ends[end]), p));
                if inside(t) {
                    return t;
                }
                return middle;
            }
            let t = if radii[0] < 0.5 * span {
                t0 + radii[0] / length
            } else if radii[1] < 0.5 * span {
                t1 - radii[1] / length
            } else {
                middle
            };
            if inside(t) {
                t
            } else {
                middle
            }
        }
        [first, _] => {
            let end = if first { 0 } else { 1 };
            let t = sphere(end, distance(points.xyz(context.ends[end]), p));
            if inside(t) {
                t
            } else {
                middle
            }
        }
    }
}

/// Rounds `t` within `(t0, t1)`: to `exact_bits` fractional bits if that grid is fine enough here (the point is then a
/// double), else to about 24 bits below the subsegment's size. None if there is no room left between the ends.
pub fn round_parameter(t: f64, t0: f64, t1: f64, exact_bits: u32) -> Option<f64> {
    let span = t1 - t0;
    let grid = |bits: u32| {
        let unit = (1u64 << bits.min(52)) as f64;
        (t * unit).round() / unit
    };
    let fine = |bits: u32| bits > 0 && 1.0 / ((1u64 << bits.min(52)) as f64) <= span / 8.0;
    let rounded = if fine(exact_bits) {
        grid(exact_bits)
    } else {
        let needed = (1.0 / span).log2().ceil().max(0.0) as u32 + 24;
        grid(needed.min(52))
    };
    (rounded > t0 && rounded < t1).then_some(rounded)
}
