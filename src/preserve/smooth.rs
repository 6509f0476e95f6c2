//! Smoothing: points inside move to where their worst tetrahedron is best.
//!
//! A compass search (Hooke & Jeeves 1961) from where the point is and from the point farthest from the planes of its star. Quality is plain
//! arithmetic and only compared; a position counts only if it sees all faces of the star exactly.
use super::center::dot;
use super::inside::Inside;
use super::place::{place_at_center, sees_all};
use super::solid::Solid;
use crate::error::Error;
use crate::mesh::star::StarSearch;
use crate::predicates::{in_range, Points};

/// Sweeps over all points, and halvings of the step.
const SWEEPS: usize = 3;
const HALVINGS: usize = 12;

/// Moves the points inside.
pub fn smooth(solid: &mut Solid, points: &mut Points, inside: &Inside) -> Result<(), Error> {
    let mut search = StarSearch::default();
    let mut faces = Vec::new();
    for _ in 0..SWEEPS {
        for &p in &inside.list {
            solid.link(&mut search, p, &mut faces)?;
            improve(points, p, &faces)?;
        }
    }
    Ok(())
}

/// Moves one point within its star.
fn improve(points: &mut Points, p: u32, faces: &[[u32; 3]]) -> Result<(), Error> {
    let start = *points.xyz(p);
    let mut best = (worst(points, &start, faces), start);
    if place_at_center(points, p, faces)? {
        let at = *points.xyz(p);
        let quality = worst(points, &at, faces);
        if quality > best.0 {
            best = (quality, at);
        }
    }
    let reach = faces.iter().flatten().map(|&v| {
        let d = points.xyz(v);
        let d = [d[0] - start[0], d[1] - start[1], d[2] - start[2]];
        dot(&d, &d)
    });
    let mut step = 0.25 * reach.fold(0.0, f64::max).sqrt();
    for _ in 0..HALVINGS {
        let from = best.1;
        for k in 0..6 {
            let mut at = from;
            at[k / 2] += if k % 2 == 0 { step } else { -step };
            let quality = worst(points, &at, faces);
            if quality > best.0 && at.iter().all(|&x| in_range(x)) {
                points.move_to(p, at)?;
                if sees_all(points, p, faces) {
                    best = (quality, at);
                }
            }
        }
        if best.1 == from {
            step *= 0.5;
        }
    }
    points.move_to(p, best.1)
}

/// The least quality of the tetrahedra from a position to the faces: volume over the cube of the mean edge length.
fn worst(points: &Points, at: &[f64; 3], faces: &[[u32; 3]]) -> f64 {
    let mut least = f64::INFINITY;
    for face in faces {
        let u = face.map(|v| {
            let p = points.xyz(v);
            [p[0] - at[0], p[1] - at[1], p[2] - at[2]]
        });
        let volume = u[0][0] * (u[1][1] * u[2][2] - u[1][2] * u[2][1])
            - u[0][1] * (u[1][0] * u[2][2] - u[1][2] * u[2][0])
            + u[0][2] * (u[1][0] * u[2][1] - u[1][1] * u[2][0]);
        let mut squares: f64 = u.iter().map(|x| dot(x, x)).sum();
        for (x, y) in [(0, 1), (1, 2), (2, 0)] {
            let d = [0, 1, 2].map(|k| u[x][k] - u[y][k]);
            squares += dot(&d, &d);
        }
        least = least.min(volume / (squares * squares.sqrt()).max(f64::MIN_POSITIVE));
    }
    least
}
