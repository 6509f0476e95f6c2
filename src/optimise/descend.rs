//! Smoothing for the worst: a vertex moves to where the smallest dihedral angle of its star is largest.
//!
//! The function is a minimum of smooth ones. Its steepest ascent is the shortest vector in the convex hull of the gradients of those that
//! are nearly the least (Freitag & Ollivier-Gooch 1997), found by Gilbert's algorithm (1966); then the step is halved until the worst is better.
//! All of this is floating-point; a position counts only if it sees all faces of the star by exact signs.
use crate::elementary::quotient;
use crate::error::Error;
use crate::fallible;
use crate::ops::place::sees_all;
use crate::ops::shape::sine;
use crate::predicates::{in_range, Points};
use crate::vector::{dot, sub};

/// The most steps of one vertex, and halvings of each. Eight steps take a quarter longer on the clean models of `quality_figures.py`, and gain
/// nothing: what is not done is done in the next pass.
const STEPS: usize = 3;
const HALVINGS: usize = 5;
/// Tetrahedra this much better than the worst count as nearly the worst, first and where that leads nowhere.
const NEARLY: [f64; 3] = [0.08, 0.03, 0.006];
/// The most gradients.
const MOST: usize = 16;
/// Slopes below this lead nowhere.
const FLAT: f64 = 1e-3;
/// The least gain of a step. A fiftieth of it takes a third longer for the same angles.
const GAIN: f64 = 0.005;

/// Where a vertex may go.
pub trait Freedom {
    /// The part of a direction that it may follow.
    fn along(&self, way: [f64; 3]) -> [f64; 3];

    /// The place next to a wanted one that it may go to; `None` if there is none.
    ///
    /// # Errors
    /// `OutOfMemory`.
    fn place(&mut self, points: &Points, wanted: [f64; 3]) -> Result<Option<[f64; 3]>, Error>;

    /// The vertex is at the last place from now on.
    ///
    /// # Errors
    /// `OutOfMemory`.
    fn take(&mut self) -> Result<(), Error>;
}

/// Anywhere.
pub struct Free;

impl Freedom for Free {
    fn along(&self, way: [f64; 3]) -> [f64; 3] {
        way
    }

    fn place(&mut self, _: &Points, wanted: [f64; 3]) -> Result<Option<[f64; 3]>, Error> {
        Ok(wanted.iter().all(|&x| in_range(x)).then_some(wanted))
    }

    fn take(&mut self) -> Result<(), Error> {
        Ok(())
    }
}

/// Moves vertices; keeps its scratch space.
#[derive(Default)]
pub struct Descend {
    values: Vec<f64>,
    gradients: Vec<[f64; 3]>,
}

impl Descend {
    /// Moves a vertex that sees these faces; returns the worst sine before and after.
    pub fn smooth(
        &mut self,
        points: &mut Points,
        p: u32,
        faces: &mut [[u32; 3]],
        enough: f64,
    ) -> Result<(f64, f64), Error> {
        self.smooth_within(points, p, faces, enough, &mut Free)
    }

    /// The same for a vertex that may not go anywhere.
    pub fn smooth_within(
        &mut self,
        points: &mut Points,
        p: u32,
        faces: &mut [[u32; 3]],
        enough: f64,
        freedom: &mut impl Freedom,
    ) -> Result<(f64, f64), Error> {
        let mut at = *points.xyz(p);
        let mut worst = self.rate(points, &at, faces)?;
        let first = worst;
        let scale = reach(points, &at, faces);
        let (mut length, mut level) = (0.2 * scale, 0);
        for _ in 0..STEPS {
            if worst >= enough || level == NEARLY.len() || !scale.is_finite() || scale <= 0.0 {
                break;
            }
            self.slopes(points, &at, faces, worst + NEARLY[level], scale)?;
            self.gradients.iter_mut().for_each(|slope| *slope = freedom.along(*slope));
            let way = shortest(&self.gradients);
            let steep = dot(&way, &way).sqrt();
            if steep < FLAT {
                level += 1;
                continue;
            }
            let mut moved = false;
            let mut step = length;
            for _ in 0..HALVINGS {
                let wanted = [0, 1, 2].map(|k| at[k] + step * way[k] / steep);
                let mut better = least_above(points, &wanted, faces, worst + GAIN);
                let to = if better.is_some() { freedom.place(points, wanted)? } else { None };
                if let Some(to) = to.filter(|to| *to != wanted) {
                    better = least_above(points, &to, faces, worst + GAIN);
                }
                if let (Some(to), Some(better)) = (to, better) {
                    points.move_to(p, to)?;
                    if sees_all(points, p, faces) {
                        freedom.take()?;
                        (at, worst, moved) = (to, better, true);
                        length = (1.5 * step).min(0.3 * scale);
                        break;
                    }
                }
                step *= 0.5;
            }
            if !moved {
                level += 1;
                length = step.max(1e-4 * scale) * 4.0;
            } else {
                self.rate(points, &at, faces)?;
            }
        }
        points.move_to(p, at)?;
        Ok((first, worst))
    }

    /// The sine of each tetrahedron; the least. The worst face comes first, so that bad positions are seen at once.
    fn rate(&mut self, points: &Points, at: &[f64; 3], faces: &mut [[u32; 3]]) -> Result<f64, Error> {
        self.values.clear();
        self.values.try_reserve(faces.len())?;
        for &face in faces.iter() {
            fallible::push(&mut self.values, of(points, at, face))?;
        }
        let mut least = 0;
        for i in 1..faces.len() {
            if self.values[i] < self.values[least] {
                least = i;
            }
        }
        if !faces.is_empty() {
            faces.swap(0, least);
            self.values.swap(0, least);
        }
        Ok(self.values.first().copied().unwrap_or(1.0))
    }

    /// The gradients of what is below a bound, in units of the star's size.
    fn slopes(
        &mut self,
        points: &Points,
        at: &[f64; 3],
        faces: &[[u32; 3]],
        below: f64,
        scale: f64,
    ) -> Result<(), Error> {
        let delta = 1e-5 * scale;
        self.gradients.clear();
        self.gradients.try_reserve(MOST)?;
        for (&value, &face) in self.values.iter().zip(faces) {
            if value > below || self.gradients.len() == MOST {
                continue;
            }
            let slope = |k: usize| {
                let mut to = *at;
                to[k] += delta;
                (of(points, &to, face) - value) / 1e-5
            };
            fallible::push(&mut self.gradients, [slope(0), slope(1), slope(2)])?;
        }
        Ok(())
    }
}

/// The sine of the tetrahedron from a position to a face.
fn of(points: &Points, at: &[f64; 3], [x, y, z]: [u32; 3]) -> f64 {
    sine([at, points.xyz(x), points.xyz(y), points.xyz(z)])
}

/// The least sine if it is above a bound.
fn least_above(points: &Points, at: &[f64; 3], faces: &[[u32; 3]], bound: f64) -> Option<f64> {
    let mut least = f64::INFINITY;
    for &face in faces {
        least = least.min(of(points, at, face));
        if least <= bound {
            return None;
        }
    }
    Some(least)
}

/// The mean distance of the faces' vertices.
fn reach(points: &Points, at: &[f64; 3], faces: &[[u32; 3]]) -> f64 {
    let far = |&v: &u32| {
        let d = sub(points.xyz(v), at);
        dot(&d, &d).sqrt()
    };
    faces.iter().flatten().map(far).sum::<f64>() / (3 * faces.len()).max(1) as f64
}

/// The shortest vector in the convex hull, or one below [`FLAT`].
fn shortest(vectors: &[[f64; 3]]) -> [f64; 3] {
    let Some(&first) = vectors.first() else { return [0.0; 3] };
    let mut best = first;
    for _ in 0..24 {
        let square = dot(&best, &best);
        let along = |v: &[f64; 3]| dot(v, &best);
        let Some(low) = vectors.iter().min_by(|x, y| along(x).total_cmp(&along(y))) else { break };
        if along(low) >= 0.99 * square || square < FLAT * FLAT {
            break;
        }
        let back = sub(low, &best);
        let Some(t) = quotient(-dot(&best, &back), dot(&back, &back)) else { break };
        let t = t.clamp(0.0, 1.0);
        best = [0, 1, 2].map(|k| best[k] + t * back[k]);
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shortest_vector_of_a_hull_is_found() {
        let near = |a: [f64; 3], b: [f64; 3]| (0..3).all(|k| (a[k] - b[k]).abs() < 0.05);
        assert!(near(shortest(&[[1.0, 0.0, 0.0]]), [1.0, 0.0, 0.0]));
        assert!(near(shortest(&[[1.0, 1.0, 0.0], [1.0, -1.0, 0.0]]), [1.0, 0.0, 0.0]));
        assert!(near(shortest(&[[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]]), [0.0; 3]));
    }

    #[test]
    fn a_vertex_goes_to_the_middle() {
        // A regular octahedron, and a point inside near one of its corners.
        let mut xyz = vec![];
        for k in 0..3 {
            for s in [1.0, -1.0] {
                let mut p = [0.0; 3];
                p[k] = s;
                xyz.push(p);
            }
        }
        xyz.push([0.7, 0.1, 0.05]);
        let mut points = Points::new(xyz);
        let mut faces = Vec::new();
        for (x, y, z) in
            [(0, 2, 4), (0, 5, 2), (0, 3, 5), (0, 4, 3), (1, 4, 2), (1, 2, 5), (1, 5, 3), (1, 3, 4)]
        {
            // Turned towards the middle.
            let seen = points.orient3d(6, x, y, z) == crate::predicates::Sign::Positive;
            faces.push(if seen { [x, y, z] } else { [x, z, y] });
        }
        let (before, after) = Descend::default().smooth(&mut points, 6, &mut faces, 2.0).unwrap();
        assert!(after > before && after > 0.75, "{before} {after}");
        assert!(sees_all(&points, 6, &faces));
    }
}
