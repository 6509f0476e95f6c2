//! Positions for interior points, in doubles: strictly on the inner side of all faces of a polyhedron.
//!
//! Candidates come from floating-point arithmetic: the point farthest from all planes, then points between it and a point `from` at which
//! the polyhedron is known to be open, halving the distance down to the last bit, then the neighbours of `from` among doubles. Exact
//! orientation accepts the first that sees every face.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::ops::center::{center, Plane};
use crate::predicates::{in_range, Points, Sign};
use crate::vector::dot;

/// How often a distance is halved: as often as doubles tell apart. 28 and 112 change nothing on six models: nothing measurable depends on
/// it.
const HALVINGS: i32 = 56;

/// Whether the point is strictly inside all faces.
pub fn sees_all(points: &Points, p: u32, faces: &[[u32; 3]]) -> bool {
    faces.iter().all(|&[x, y, z]| points.orient3d(p, x, y, z) == Sign::Positive)
}

/// The planes of the faces, coordinates relative to `origin`; faces that are flat in plain arithmetic are left out.
pub fn planes(
    points: &Points,
    faces: &[[u32; 3]],
    origin: &[f64; 3],
    out: &mut Vec<Plane>,
) -> Result<f64, Error> {
    out.clear();
    out.try_reserve(faces.len())?;
    let mut size = 0.0f64;
    for face in faces {
        let [x, y, z] = face.map(|v| {
            let p = points.xyz(v);
            [p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]]
        });
        for c in [x, y, z] {
            size = size.max(dot(&c, &c));
        }
        let u = [y[0] - x[0], y[1] - x[1], y[2] - x[2]];
        let w = [z[0] - x[0], z[1] - x[1], z[2] - x[2]];
        // (p, x, y, z) is positive where (y − x) × (z − x) points away from.
        let n = [w[1] * u[2] - w[2] * u[1], w[2] * u[0] - w[0] * u[2], w[0] * u[1] - w[1] * u[0]];
        let length = dot(&n, &n).sqrt();
        if length > 0.0 && length.is_finite() {
            let normal = n.map(|a| a / length);
            fallible::push(out, Plane { normal, offset: -dot(&normal, &x) })?;
        }
    }
    Ok(size.sqrt())
}

/// Moves point `p` to a position that sees all faces; `from` is near which the polyhedron is open, `toward` are directions into
/// it. False if no position was found.
pub fn place(
    points: &mut Points,
    p: u32,
    faces: &[[u32; 3]],
    from: [f64; 3],
    toward: &[[f64; 3]],
    control: &Control,
) -> Result<bool, Error> {
    let mut list = Vec::new();
    let size = planes(points, faces, &from, &mut list)?;
    let (best, _) = center(&list, 4.0 * size.max(f64::MIN_POSITIVE));
    let mut ways: Vec<[f64; 3]> = fallible::reserved(toward.len() + 1)?;
    fallible::push(&mut ways, best)?;
    for way in toward {
        let length = dot(way, way).sqrt();
        if length > 0.0 && length.is_finite() {
            fallible::push(&mut ways, way.map(|x| x / length * size))?;
        }
    }
    for way in &ways {
        let mut factor = 1.0;
        for _ in 0..HALVINGS {
            control.step()?;
            let q = [0, 1, 2].map(|k| from[k] + factor * way[k]);
            if accept(points, p, q, faces)? {
                return Ok(true);
            }
            factor *= 0.5;
        }
    }
    for dx in -2..=2 {
        for dy in -2..=2 {
            for dz in -2..=2 {
                let q = [step(from[0], dx), step(from[1], dy), step(from[2], dz)];
                if accept(points, p, q, faces)? {
                    return Ok(true);
                }
            }
        }
    }
    Ok(false)
}

/// Moves point `p` to the point that is farthest from the planes of all faces, if it sees them; false (and `p` somewhere) if not.
pub fn place_at_center(points: &mut Points, p: u32, faces: &[[u32; 3]]) -> Result<bool, Error> {
    let from = *points.xyz(p);
    let mut list = Vec::new();
    let size = planes(points, faces, &from, &mut list)?;
    let (best, distance) = center(&list, 4.0 * size.max(f64::MIN_POSITIVE));
    if distance <= 0.0 {
        return Ok(false);
    }
    accept(points, p, [0, 1, 2].map(|k| from[k] + best[k]), faces)
}

fn accept(points: &mut Points, p: u32, q: [f64; 3], faces: &[[u32; 3]]) -> Result<bool, Error> {
    if !q.iter().all(|&x| in_range(x)) {
        return Ok(false);
    }
    points.move_to(p, q)?;
    Ok(sees_all(points, p, faces))
}

/// The double this many units in the last place above.
pub fn step(mut x: f64, count: i32) -> f64 {
    for _ in 0..count.abs() {
        x = if count > 0 { x.next_up() } else { x.next_down() };
    }
    x
}
