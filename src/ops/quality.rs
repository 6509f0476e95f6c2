//! The quality of a tetrahedron in floating-point arithmetic: it orders searches and chooses among valid fillings.

use crate::vector::{cross, dot, sub};

/// The volume over the cube of the mean edge length, up to a factor; not positive if the tetrahedron is not.
pub fn quality([o, p, q, r]: [&[f64; 3]; 4]) -> f64 {
    let [u, v, w] = [sub(p, o), sub(q, o), sub(r, o)];
    let edges = [u, v, w, sub(p, q), sub(q, r), sub(r, p)];
    let squares: f64 = edges.iter().map(|e| dot(e, e)).sum();
    dot(&u, &cross(&v, &w)) / (squares * squares.sqrt()).max(f64::MIN_POSITIVE)
}
