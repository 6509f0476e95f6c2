//! Where to put a point on a segment that resists recovery.
//!
//! The point goes into one of the inner tetrahedra of the segment's corridor, so that both pieces cross fewer faces and edges: into
//! the longest stretch among those of the middle half. Two points on both sides of one face are joined by a flip; two on both sides of
//! one edge by filling its ring, which works when they are close enough to it: the inside of an edge sees all of its ring. So a
//! piece that crosses one edge is divided beside that edge.
//!
//! Plain arithmetic: every position between the ends is valid.
use crate::error::Error;
use crate::fallible;
use crate::predicates::Points;
use crate::preserve::recover::corridor::Feature;
use crate::vector::{cross, dot, sub};

/// How much nearer to its only edge a piece gets its point: nearer is likelier to be seen from the edge's ring, but makes shorter pieces.
/// None of the models measured reaches it.
const BESIDE: f64 = 0.125;

/// The parameter between `a` and `b` at which the piece is divided.
pub fn breakpoint(
    points: &Points,
    [a, b]: [u32; 2],
    features: &[Feature],
    places: &mut Vec<f64>,
) -> Result<f64, Error> {
    places.clear();
    fallible::push(places, 0.0)?;
    let mut last = 0.0f64;
    for feature in features {
        let t = crossing(points, [a, b], feature);
        if t > last && t < 1.0 {
            last = t;
            fallible::push(places, t)?;
        }
    }
    fallible::push(places, 1.0)?;
    let gap = |i: usize| places[i + 1] - places[i];
    let count = places.len() - 1;
    if count == 1 {
        return Ok(0.5);
    }
    if count == 2 {
        let t = places[1];
        return Ok(if t > 0.5 { t - BESIDE * t } else { t + BESIDE * (1.0 - t) });
    }
    // The first and the last stretch lie in tetrahedra at the ends: a point there brings the piece no further.
    let from = (count / 4).max(1);
    let mut best = from;
    for i in from..count - from {
        if gap(i) > gap(best) {
            best = i;
        }
    }
    Ok(0.5 * (places[best] + places[best + 1]))
}

/// Where the way from `a` to `b` crosses a feature.
fn crossing(points: &Points, [a, b]: [u32; 2], feature: &Feature) -> f64 {
    let from = points.xyz(a);
    let at = |v: u32| sub(points.xyz(v), from);
    let along = at(b);
    match *feature {
        Feature::Face([x, y, z]) => {
            let (x, y, z) = (at(x), at(y), at(z));
            let normal = cross(&sub(&y, &x), &sub(&z, &x));
            dot(&normal, &x) / dot(&normal, &along)
        }
        Feature::Edge([p, q]) => {
            let (p, q) = (at(p), at(q));
            let e = sub(&q, &p);
            let normal = cross(&along, &e);
            dot(&cross(&p, &e), &normal) / dot(&normal, &normal)
        }
    }
}
