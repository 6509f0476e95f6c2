//! Where to split a missing subsegment: the rules of Si & Gärtner 2011, section 5, with shared radii.
//!
//! Any parameter strictly inside the subsegment gives a valid mesh; only the number of Steiner points is at stake. So
//! lengths and angles are approximate here, and the parameter is rounded to so few bits that the point is an exact double where possible.
use crate::elementary::{exponent, power_of_two};
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

/// Least distance of the point nearest to the reference point from the ends of a subsegment, as a fraction of its length.
///
/// If it is nearer, the midpoint is used, which is a new height at which neighbours have to be split as well; a piece that is too short is
/// split again and again. On the public models values from 0.05 to 0.14 need about the same number of points, 0.2 needs 8 % more.
const NEAR: f64 = 0.1;
/// The same for the sphere around a common vertex.
///
/// Equal radii must stay equal: then one row of Steiner points crosses a fan or a strip of slivers, whereas each point put at a midpoint
/// instead begins a row of its own. With 0.2 the public models need 12 % more points when facets are merged.
const NEAR_SHARED: f64 = 1e-4;

/// Length of the vector from `a` to `b`.
pub fn distance(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    let d = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
    (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt()
}

/// The context of the segment to be split.
pub struct Context {
    /// The input ends.
    pub ends: [u32; 2],
    /// Whether the ends are acute vertices (two segments meet there at less than 90°); needed only for very short pieces.
    pub acute: [bool; 2],
    /// The end that this segment has in common with the reference point's own segment.
    pub shared: Option<usize>,
}

/// Pieces shorter than this fraction of their segment are split on concentric shells, which always terminates.
const DEEP: f64 = 1.0 / (1u64 << 20) as f64;

impl Subsegment {
    /// Whether it is so short that it is split on concentric shells.
    pub fn is_deep(&self) -> bool {
        self.t[1] - self.t[0] < DEEP
    }
}

/// The parameter at which to split `sub`, seen from reference vertex `reference`.
///
/// In order of preference: the sphere around a common input vertex of the two segments, so that all segments of a fan are split at equal
/// radii and stop splitting each other; the point of the segment nearest to the reference point, which leaves the latter outside the
/// diametric balls of both halves; the midpoint. The paper's spheres around the piece's ends give a quarter to a half more points on our
/// models. Very short pieces fall back on its protecting spheres: at acute ends the radius is a power of two (Ruppert 1995, concentric
/// shells), elsewhere the midpoint is used.
pub fn choose(points: &Points, sub: &Subsegment, context: &Context, reference: Option<u32>) -> f64 {
    let [t0, t1] = sub.t;
    let (a, b) = (points.xyz(context.ends[0]), points.xyz(context.ends[1]));
    let length = distance(a, b);
    let inside = |t: f64, near: f64| t >= t0 + near * (t1 - t0) && t <= t1 - near * (t1 - t0);
    let sphere = |end: usize, radius: f64| [radius / length, 1.0 - radius / length][end];
    let middle = t0 + 0.5 * (t1 - t0);
    if sub.is_deep() {
        let shell = power_of_two(exponent(std::f64::consts::FRAC_1_SQRT_2 * (t1 - t0) * length));
        return match (context.acute[0] && t0 == 0.0, context.acute[1] && t1 == 1.0) {
            (true, false) => sphere(0, shell),
            (false, true) => sphere(1, shell),
            _ => middle,
        };
    }
    let Some(reference) = reference else { return middle };
    let p = points.xyz(reference);
    if let Some(end) = context.shared {
        let t = sphere(end, distance([a, b][end], p));
        if inside(t, NEAR_SHARED) {
            return t;
        }
    }
    let nearest = (0..3).map(|k| (b[k] - a[k]) * (p[k] - a[k])).sum::<f64>() / (length * length);
    if inside(nearest, NEAR) {
        nearest
    } else {
        middle
    }
}

/// Bits below a piece's size to which parameters are rounded. Fans of segments at angles of 10⁻³ need radii that agree to 10⁻⁶, or they
/// keep splitting each other.
const EXACT_BITS: i32 = 20;
/// The same if the point is no double anyway.
const IMPLICIT_BITS: u32 = 36;

/// Rounds `t` within `(t0, t1)`: to `exact_bits` fractional bits if that grid is fine enough here (the point is then a double), otherwise
/// to more. `None` if there is no room between the ends.
pub fn round_parameter(t: f64, t0: f64, t1: f64, exact_bits: u32) -> Option<f64> {
    let span = t1 - t0;
    let grid = |bits: u32| {
        let unit = power_of_two(bits.min(1000) as i32);
        (t * unit).round() / unit
    };
    let exact_is_fine =
        exact_bits > 0 && power_of_two(-(exact_bits as i32)) <= span * power_of_two(-EXACT_BITS);
    let rounded =
        if exact_is_fine { grid(exact_bits) } else { grid((-exponent(span)).max(0) as u32 + IMPLICIT_BITS) };
    (rounded > t0 && rounded < t1).then_some(rounded)
}
