//! Candidates: where they are, and in which tetrahedron.
use crate::elementary::{exponent_above, power_of_two, quotient};
use crate::kernel::{Mesh, NONE};
use crate::predicates::{in_range, Points, Sign};
use crate::vector::{cross, dot, sub};

/// The most tetrahedra that a walk passes.
const MOST_STEPS: usize = 2000;
/// Candidates have about this many bits below their distance from what is near: short numbers keep exact signs quick.
const BITS: i32 = 16;

/// No coordinate is larger than a fraction of this, 2^300.
pub(crate) const FARTHEST: f64 = f64::from_bits((300 + 1023) << 52);
/// Doubles of this size are whole numbers.
const WHOLE: f64 = (1u64 << 53) as f64;

/// Where a walk ended.
pub(super) enum Found {
    /// Strictly inside this tetrahedron.
    In(u32),
    /// Before this wall, given by the corner on this side.
    Blocked(u32),
    /// On a face, or the walk was too long.
    Nowhere,
}

/// Walks to a vertex that is not in the mesh, through faces that have it on their other side (Devillers, Pion & Teillaud 2002). Signs are exact. A
/// walk in a mesh that is not Delaunay may go round in circles: its length is bounded, and the order of the faces changes at every step.
pub(super) fn locate(mesh: &Mesh, points: &Points, p: u32, start: u32) -> Found {
    let (mut t, mut from) = (start, NONE);
    for step in 0..MOST_STEPS {
        let (mut next, mut wall, mut inside) = (None, None, true);
        for k in 0..4 {
            let code = 4 * t + ((k + step as u32) & 3);
            let across = mesh.across(code);
            if across >> 2 == from {
                continue;
            }
            let [x, y, z] = mesh.face(code);
            match points.orient3d(p, x, y, z) {
                Sign::Positive => {}
                Sign::Zero => inside = false,
                Sign::Negative if mesh.is_wall(code) => wall = Some(code),
                Sign::Negative => {
                    next = Some(across >> 2);
                    break;
                }
            }
        }
        match (next, wall) {
            (Some(n), _) => (from, t) = (t, n),
            (None, Some(wall)) => return Found::Blocked(wall),
            // What it came through has it strictly on this side.
            (None, None) if inside => return Found::In(t),
            _ => return Found::Nowhere,
        }
    }
    Found::Nowhere
}

/// The circumcentre and circumradius of a tetrahedron; the radius is infinite if it is flat.
pub fn circumcentre([o, p, q, r]: [&[f64; 3]; 4]) -> ([f64; 3], f64) {
    let [u, v, w] = [sub(p, o), sub(q, o), sub(r, o)];
    let [vw, wu, uv] = [cross(&v, &w), cross(&w, &u), cross(&u, &v)];
    let det = 2.0 * dot(&u, &vw);
    let [uu, vv, ww] = [dot(&u, &u), dot(&v, &v), dot(&w, &w)];
    let n = [0, 1, 2].map(|k| uu * vw[k] + vv * wu[k] + ww * uv[k]);
    // What is farther than this is beyond all coordinates; hosts may trap a division by zero and an overflow.
    if !n.iter().all(|x| x.abs() < det.abs() * FARTHEST) {
        return (*o, f64::INFINITY);
    }
    let d = n.map(|x| x / det);
    ([0, 1, 2].map(|k| o[k] + d[k]), dot(&d, &d).sqrt())
}

/// The point on a grid that is fine compared with a distance; `None` if it is out of range.
pub fn snapped(at: [f64; 3], near: f64) -> Option<[f64; 3]> {
    if !near.is_finite() || near <= 0.0 {
        return None;
    }
    let unit = power_of_two((exponent_above(near) - BITS).clamp(-900, 900));
    let out = at.map(|x| {
        // Larger numbers are on the grid.
        if x.abs() < unit * WHOLE {
            (x / unit).round() * unit
        } else {
            x
        }
    });
    out.iter().all(|&x| in_range(x)).then_some(out)
}

/// How far a triangle is from a needle: 1 if it is equilateral, near 0 if one of its angles is.
pub(super) fn needle_free([p, q, r]: [&[f64; 3]; 3]) -> f64 {
    let [u, v, w] = [sub(q, p), sub(r, p), sub(r, q)];
    let n = cross(&u, &v);
    let longest = dot(&u, &u).max(dot(&v, &v)).max(dot(&w, &w));
    quotient(dot(&n, &n).sqrt(), longest).unwrap_or(0.0).min(1.0)
}
