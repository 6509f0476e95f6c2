//! Where to split a missing subsegment: the rules of Si & Gärtner 2011, section 5, with equal distances.
//!
//! Any parameter strictly inside the subsegment gives a valid mesh; only the number of Steiner points is at stake. So
//! lengths and angles are approximate here, and the parameter is rounded to so few bits that the point is an exact double where possible.
//!
//! Equal distances: let the lines of two segments be nearest to each other at c and c', a distance h apart and at an angle of 2 a, and let
//! p and p' be on them at the same distance x from c and c', on the same side. Then p is in no diametric ball of a piece of length l from
//! p' outwards, since (p' − p)·(q' − p) = h² + 2 x (2 x + l) sin² a for its far end q', nor of one inwards if l < 2 x. So the two segments
//! stop splitting each other. After the foot of the perpendicular from p instead, p' is in the ball of a piece at p, whose next foot is
//! nearer to c by a factor of cos 2 a: on fans an ulp thick that went on for thousands of points. Where the segments have a common end, c
//! and c' are that end. The points of all lines at equal distances lie in planes perpendicular to the bisector of the two directions, so c
//! and c' are not needed.
use crate::elementary::{exponent, power_of_two};
use crate::predicates::Points;
use crate::vector::{cross, dot, sub};

/// Least distance of a foot, or of the place nearest to the other line, from the ends of a subsegment, as a fraction of its length.
///
/// If it is nearer, the midpoint is used, which is a new height at which neighbours have to be split as well; a piece that is too short is
/// split again and again. On the public models 0.05 needs 2.5 % more points, 0.2 needs 0.5 % more.
const NEAR: f64 = 0.1;
/// The same for points at equal distances.
///
/// Equal distances must stay equal: then one row of Steiner points crosses a fan or a strip of slivers, whereas each point put at a
/// midpoint instead begins a row of its own. With 0.01 the public models need 7 % more points, also when facets are merged; with 1e-6, 1 %
/// fewer, in pieces so short that rounding has less room.
const NEAR_EQUAL: f64 = 1e-4;
/// Pieces shorter than this fraction of their segment are split on concentric shells, which always terminates. Half of it and double change
/// nothing on 15 models: it only bounds the work on worse ones.
const DEEP: f64 = 1.0 / (1u64 << 20) as f64;
/// Bits below a piece's size to which parameters are rounded. Fans of segments at angles of 10⁻³ need radii that agree to 10⁻⁶, or they
/// keep splitting each other; with more bits fewer points are exact doubles. On 15 models with 23,337 Steiner points 16 takes 0.1 % more,
/// 24 1.4 % fewer (−2 to 0 % on single ones).
const EXACT_BITS: i32 = 20;
/// The same if the point is no double anyway. On 13 models with 22,900 Steiner points 32 takes 1.7 % more (−4 to +10 % on single ones), 40
/// 0.4 % fewer (−5 to +5 % on single ones).
const IMPLICIT_BITS: u32 = 36;

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

/// Length of the vector from `a` to `b`.
pub fn distance(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    let d = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
    (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt()
}

/// How the reference point's own segment lies to the one being split.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OwnSegment {
    /// The reference point is on no segment, or an end of some.
    Unknown,
    /// They have this end of the segment being split in common.
    Shares(usize),
    /// It has other ends: these.
    Apart([u32; 2]),
}

/// The context of the segment to be split.
pub struct Context {
    /// The input ends.
    pub ends: [u32; 2],
    /// Whether the ends are acute vertices (two segments meet there at less than 90°); needed only for very short pieces.
    pub acute: [bool; 2],
    /// The reference point's own segment.
    pub own: OwnSegment,
}

impl Subsegment {
    /// Whether it is so short that it is split on concentric shells.
    pub fn is_deep(&self) -> bool {
        self.t[1] - self.t[0] < DEEP
    }
}

/// The parameter at which to split `sub`, seen from reference vertex `reference`.
///
/// In order of preference: at equal distances (see above); where the line is nearest to the reference point's own segment; at the point
/// nearest to the reference point, which leaves the latter outside the diametric balls of both halves; the midpoint. The paper's spheres
/// around the piece's ends give a quarter to a half more points on our models. Very short pieces fall back on its protecting spheres: at
/// acute ends the radius is a power of two (Ruppert 1995, concentric shells), elsewhere the midpoint is used.
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
    let lines = match context.own {
        OwnSegment::Apart(other) => Some(Lines::new([a, b], other.map(|v| points.xyz(v)))),
        _ => None,
    };
    let equal = match context.own {
        OwnSegment::Shares(end) => Some(sphere(end, distance([a, b][end], p))),
        _ => lines.as_ref().map(|lines| lines.equal(p)),
    };
    if let Some(t) = equal.filter(|&t| inside(t, NEAR_EQUAL)) {
        return t;
    }
    let nearest = lines.and_then(|lines| lines.nearest());
    let foot = (0..3).map(|k| (b[k] - a[k]) * (p[k] - a[k])).sum::<f64>() / (length * length);
    [nearest, Some(foot)].into_iter().flatten().find(|&t| inside(t, NEAR)).unwrap_or(middle)
}

/// The lines of two segments.
struct Lines<'a> {
    a: &'a [f64; 3],
    c: &'a [f64; 3],
    /// From first to second end.
    d: [f64; 3],
    e: [f64; 3],
}

impl<'a> Lines<'a> {
    fn new([a, b]: [&'a [f64; 3]; 2], [c, end]: [&'a [f64; 3]; 2]) -> Self {
        Lines { a, c, d: sub(b, a), e: sub(end, c) }
    }

    /// The parameter on the first line at the distance of p, on the second, from where the two are nearest to each other.
    fn equal(&self, p: &[f64; 3]) -> f64 {
        let u = bisector(&self.d, &self.e);
        dot(&sub(p, self.a), &u) / dot(&self.d, &u)
    }

    /// The parameter on the first line where it is nearest to the second; `None` if they are parallel.
    fn nearest(&self) -> Option<f64> {
        let normal = cross(&self.d, &self.e);
        let square = dot(&normal, &normal);
        (square > 0.0).then(|| dot(&cross(&sub(self.c, self.a), &self.e), &normal) / square)
    }
}

/// The direction that halves the acute angle between two lines, up to its length. The same, or its opposite, for the two in either order
/// and direction.
pub fn bisector(d: &[f64; 3], e: &[f64; 3]) -> [f64; 3] {
    let [x, y] = [d, e].map(|v| {
        let length = dot(v, v).sqrt();
        v.map(|x| x / length)
    });
    let sign = if dot(&x, &y) < 0.0 { -1.0 } else { 1.0 };
    std::array::from_fn(|k| x[k] + sign * y[k])
}

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
