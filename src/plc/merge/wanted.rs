//! Measures that decide which flips are wanted: angles between triangles, angles opposite an edge, distances.
//!
//! Rounded arithmetic: any sequence of allowed flips gives a valid surface, so only quality is at stake here. A flip whose measure
//! overflows is not wanted.
use crate::elementary::{cosine_of_degrees, exponent, quotient};
use crate::predicates::scale;
use crate::vector::{cross, dot, sub};

type Vector = [f64; 3];

/// The bound on the angle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bound {
    /// Squares of sine and cosine of the angle between normals.
    sine_squared: f64,
    cosine_squared: f64,
}

impl Bound {
    /// Triangles may be flipped if they meet at more than `degrees` (180 is flat).
    pub(super) fn new(degrees: f64) -> Bound {
        let between = 180.0 - degrees.clamp(90.0, 180.0);
        let (sine, cosine) = (cosine_of_degrees(90.0 - between), cosine_of_degrees(between));
        Bound { sine_squared: sine * sine, cosine_squared: cosine * cosine }
    }

    /// Whether two normals differ by less than the bound.
    fn holds(&self, u: &Vector, v: &Vector) -> bool {
        // Of size one: the normals are products already, and their fourth powers would overflow.
        let (Some(u), Some(v)) = (unit(u), unit(v)) else { return false };
        let (along, across) = (dot(&u, &v), cross(&u, &v));
        along > 0.0 && dot(&across, &across) * self.cosine_squared < self.sine_squared * along * along
    }
}

/// Two triangles `abc` and `bad`, and the two `cad` and `dbc` they may become.
pub(super) struct Quadrilateral<'a> {
    vertices: [&'a Vector; 4],
    /// Twice the area vectors, oriented alike.
    old: [Vector; 2],
    new: [Vector; 2],
}

impl<'a> Quadrilateral<'a> {
    pub(super) fn new(vertices: [&'a Vector; 4]) -> Self {
        let [a, b, c, d] = vertices;
        let normal = |p, q, r| cross(&sub(q, p), &sub(r, p));
        let (old, new) = ([normal(a, b, c), normal(b, a, d)], [normal(c, a, d), normal(d, b, c)]);
        Quadrilateral { vertices, old, new }
    }

    /// Whether the angles at `c` and `d`, opposite `ab`, sum to more than 180 degrees: the sine of the sum is negative by more than
    /// rounding.
    pub(super) fn is_not_delaunay(&self) -> bool {
        let [a, b, c, d] = self.vertices;
        let [area_c, area_d] = self.old.each_ref().map(|n| dot(n, n).sqrt());
        let (ca, cb, da, db) = (sub(a, c), sub(b, c), sub(a, d), sub(b, d));
        let sine = dot(&ca, &cb) * area_d + dot(&da, &db) * area_c;
        let sizes = [ca, cb, da, db].iter().map(|v| dot(v, v).sqrt()).product::<f64>();
        sine < -1e-13 * sizes
    }

    /// Whether the two old triangles are parallel within the bound.
    pub(super) fn meets_within(&self, bound: &Bound) -> bool {
        bound.holds(&self.old[0], &self.old[1])
    }

    /// Whether all four triangles, old and new, are parallel within the bound.
    pub(super) fn is_within(&self, bound: &Bound) -> bool {
        let ([p, q], [r, s]) = (&self.old, &self.new);
        [(p, q), (r, s), (p, r), (p, s), (q, r), (q, s)].iter().all(|(u, v)| bound.holds(u, v))
    }
}

/// The distance between the lines `ab` and `cd`; infinite if they are parallel.
pub(super) fn distance([a, b, c, d]: [&Vector; 4]) -> f64 {
    let normal = cross(&sub(b, a), &sub(d, c));
    quotient(dot(&normal, &sub(c, a)).abs(), dot(&normal, &normal).sqrt()).unwrap_or(f64::INFINITY)
}

/// The vector times a power of two, so that its largest component is between 1 and 2; `None` for the zero vector.
fn unit(v: &Vector) -> Option<Vector> {
    let largest = v.iter().fold(0.0f64, |m, x| m.max(x.abs()));
    (largest > 0.0).then(|| v.map(|x| scale(x, -exponent(largest))))
}
