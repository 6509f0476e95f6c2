//! Where to split a subsegment next to a vertex extremely close to it: parameters with more bits than a double has.
//!
//! Let a vertex be at distance h from a piece of length L. If the piece is split at the vertex's distance from where the two segments meet
//! or are nearest to each other (see [`placement`](crate::segments::placement)), then it and the vertex's own segment stop splitting each other; but
//! only if the position is accurate to (h/L)² L, which is how far a diametric sphere recedes from its segment. With a larger error, both
//! keep splitting each other down to pieces of length h, of which there may be 2⁵³. So the position is computed to this precision, which
//! for segments an ulp apart is twice that of a double. Any position strictly inside gives a valid mesh: only the number of Steiner points
//! is at stake, so the lengths that determine the precision are approximate.
use crate::elementary::{exponent, power_of_two};
use crate::predicates::{Expansion, Points, Sign};
use crate::segments::placement::{bisector, OwnSegment};
use crate::vector::{cross, dot, sub};

/// Bits beyond (h/L)², since copies of copies of a radius have to agree. On two models with 439 Steiner points 16 takes 3.4 % fewer (−11 to
/// 0 % on single ones), 24 3.4 % fewer (−11 to 0 % on single ones).
const SPARE_BITS: i32 = 20;
/// Limit on the corrections of the first approximation, of about 50 bits each. 10 and 40 change nothing on two models.
const MOST_STEPS: usize = 20;
/// The finest grid of parameters. −860 and −700 change nothing on two models.
const FINEST: i32 = -780;

/// The piece and the vertex next to it.
pub struct Beside {
    /// The ends of the segment.
    pub ends: [u32; 2],
    /// The parameters of the piece's ends.
    pub t: [Expansion; 2],
    /// The vertex.
    pub reference: u32,
    /// The vertex's own segment.
    pub own: OwnSegment,
}

/// Distance of the vertex from the segment's line, as a fraction of the segment's length.
pub fn relative_distance(points: &Points, ends: [u32; 2], p: u32) -> f64 {
    let [a, b, p_near] = [ends[0], ends[1], p].map(|v| points.xyz(v));
    let (d, w) = (sub(b, a), sub(p_near, a));
    let normal = cross(&w, &d);
    dot(&normal, &normal).sqrt() / dot(&d, &d)
}

/// Like [`relative_distance`], from exact coordinates.
fn exact_relative_distance(d: &Vector, w: &Vector) -> f64 {
    let normal = vector_product(w, d).map(|x| x.approximate());
    let length = scalar_product(d, d).approximate();
    // Scaled by the largest component, since squares may underflow.
    let largest = normal.iter().fold(0.0f64, |m, x| m.max(x.abs()));
    if largest == 0.0 {
        return 0.0;
    }
    let ratio: f64 = normal.iter().map(|x| (x / largest) * (x / largest)).sum();
    largest * ratio.sqrt() / length
}

type Vector = [Expansion; 3];

fn vector(points: &Points, from: u32, to: u32) -> Vector {
    let (p, q) = (points.exact_coordinates(from), points.exact_coordinates(to));
    std::array::from_fn(|k| q[k].difference(&p[k]).compressed())
}

fn scalar_product(a: &Vector, b: &Vector) -> Expansion {
    (0..3).fold(Expansion::zero(), |sum, k| sum.sum(&a[k].product(&b[k]))).compressed()
}

fn vector_product(a: &Vector, b: &Vector) -> Vector {
    std::array::from_fn(|k| {
        let (u, v) = ((k + 1) % 3, (k + 2) % 3);
        a[u].product(&b[v]).difference(&a[v].product(&b[u])).compressed()
    })
}

impl Beside {
    /// The parameter that matches the vertex, if that is strictly inside the piece.
    pub fn matched(&self, points: &Points) -> Option<Expansion> {
        let from = if let OwnSegment::Shares(end) = self.own { end } else { 0 };
        let d = vector(points, self.ends[from], self.ends[1 - from]);
        let w = vector(points, self.ends[from], self.reference);
        let span = self.t[1].difference(&self.t[0]).approximate();
        let apart = exact_relative_distance(&d, &w);
        let window = apart * apart / span;
        let finest = exponent(window).max(FINEST + SPARE_BITS) - SPARE_BITS;
        let quantum = power_of_two(finest.max(FINEST));
        let t = match self.own {
            OwnSegment::Unknown => foot(&d, &w, &d, quantum),
            OwnSegment::Shares(_) => sphere(&d, &w, quantum),
            OwnSegment::Apart([c, end]) => {
                let e = vector(points, c, end);
                // At most once for two segments; until then the pieces are too long for equal distances to suffice.
                let nearest = nearest(&d, &vector(points, self.ends[0], c), &e, quantum);
                if let Some(t) = nearest.filter(|t| self.is_inside(t)) {
                    return Some(t);
                }
                let [d_near, e_near] = [&d, &e].map(|x| x.each_ref().map(Expansion::approximate));
                foot(&d, &w, &bisector(&d_near, &e_near).map(Expansion::from), quantum)
            }
        };
        let t = if from == 0 { t } else { Expansion::from(1.0).difference(&t).compressed() };
        self.is_inside(&t).then_some(t)
    }

    /// The midpoint of the piece, with a limited number of bits.
    pub fn middle(&self) -> Option<Expansion> {
        let span = self.t[1].difference(&self.t[0]).approximate();
        let quantum = power_of_two((exponent(span) - 30).max(FINEST));
        let t = rounded(&self.t[0].sum(&self.t[1]).scale(0.5), quantum);
        self.is_inside(&t).then_some(t)
    }

    fn is_inside(&self, t: &Expansion) -> bool {
        t.difference(&self.t[0]).sign() == Sign::Positive && self.t[1].difference(t).sign() == Sign::Positive
    }
}

/// The nearest multiple of `quantum`, a power of two, or an adjacent one.
fn rounded(x: &Expansion, quantum: f64) -> Expansion {
    let multiples = x.components().iter().map(|&x| Expansion::from((x / quantum).round() * quantum));
    multiples.fold(Expansion::zero(), |sum, x| sum.sum(&x)).compressed()
}

/// The t with |t d| = |w|, to a multiple of `quantum`: by Newton's method with exact residuals.
fn sphere(d: &Vector, w: &Vector, quantum: f64) -> Expansion {
    let (length, radius) = (scalar_product(d, d), scalar_product(w, w));
    let slope = length.approximate();
    let start = (radius.approximate() / slope).sqrt();
    correct(start, quantum, |t| {
        let residual = radius.difference(&t.product(t).product(&length)).compressed();
        residual.approximate() / (2.0 * t.approximate() * slope)
    })
}

/// The t with (w − t d)·u = 0, to a multiple of `quantum`.
fn foot(d: &Vector, w: &Vector, u: &Vector, quantum: f64) -> Expansion {
    solve(&scalar_product(w, u), &scalar_product(d, u), quantum)
}

/// The t at which t d is nearest to the line through v in direction e, to a multiple of `quantum`; `None` if they are parallel or t is not
/// between 0 and 1.
fn nearest(d: &Vector, v: &Vector, e: &Vector, quantum: f64) -> Option<Expansion> {
    let normal = vector_product(d, e);
    let square = scalar_product(&normal, &normal);
    let along = scalar_product(&vector_product(v, e), &normal);
    let inside = along.sign() == Sign::Positive && square.difference(&along).sign() == Sign::Positive;
    inside.then(|| solve(&along, &square, quantum))
}

/// `along / length`, to a multiple of `quantum`.
fn solve(along: &Expansion, length: &Expansion, quantum: f64) -> Expansion {
    let slope = length.approximate();
    correct(along.approximate() / slope, quantum, |t| {
        along.difference(&t.product(length)).compressed().approximate() / slope
    })
}

/// Adds corrections, in multiples of `quantum`, until they vanish.
fn correct(start: f64, quantum: f64, correction: impl Fn(&Expansion) -> f64) -> Expansion {
    let mut t = rounded(&Expansion::from(start), quantum);
    for _ in 0..MOST_STEPS {
        let step = rounded(&Expansion::from(correction(&t)), quantum);
        if step.sign() == Sign::Zero {
            break;
        }
        t = t.sum(&step).compressed();
    }
    t
}
