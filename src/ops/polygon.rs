//! Triangulations of small planar polygons, by dynamic programming (Klincsek 1980).
//!
//! A combinatorial triangulation of a simple polygon whose triangles all have the polygon's orientation is a triangulation of it: its
//! boundary winds once around inner points and never around outer ones. So orientations are the only exact signs needed; costs only choose.

use crate::error::Error;
use crate::fallible;
use crate::predicates::{Points, Sign};
use crate::vector::dot;

/// The largest polygon for the dynamic program, which is cubic; larger ones are triangulated by clipping ears, so that they have one
/// triangulation to choose from. 24 and 96 change nothing on four models.
const MOST_CORNERS: usize = 48;

/// What a wanted edge saves, in costs of triangles: as much of the shape of triangles is given up for it. 0 and 1 change nothing on one
/// model.
const BONUS: f64 = 1e6;

/// Triangulates polygons; keeps its scratch space.
#[derive(Default)]
pub struct Polygons {
    cost: Vec<f64>,
    apex: Vec<u8>,
    stack: Vec<(usize, usize)>,
}

impl Polygons {
    /// The triangulations of the polygon, oriented like it, without repetition: the cheapest first, then the cheapest for each apex
    /// over the edge from the last corner to the first.
    pub fn triangulations(
        &mut self,
        points: &Points,
        axis: usize,
        polygon: &[u32],
        wanted: &dyn Fn(u32, u32) -> bool,
    ) -> Result<Vec<Vec<[u32; 3]>>, Error> {
        let n = polygon.len();
        let mut out: Vec<Vec<[u32; 3]>> = Vec::new();
        if n < 3 {
            return Ok(out);
        }
        let Some(turn) = turn(points, axis, polygon) else { return Ok(out) };
        if n > MOST_CORNERS {
            fallible::extend(&mut out, clip_ears(points, axis, polygon, turn)?)?;
            return Ok(out);
        }
        self.solve(points, axis, polygon, turn, wanted)?;
        let mut apexes: Vec<(f64, usize)> = fallible::reserved(n)?;
        for k in 1..n - 1 {
            let cost = self.with_apex(points, axis, polygon, turn, [0, k, n - 1]);
            if cost.is_finite() {
                fallible::push(&mut apexes, (cost, k))?;
            }
        }
        apexes.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        out.try_reserve(apexes.len())?;
        for (_, k) in apexes {
            self.apex[n - 1] = k as u8;
            fallible::push(&mut out, self.collect(polygon)?)?;
        }
        Ok(out)
    }

    /// The tables: per chain of corners from `i` to `j` the least cost and the apex over `ij`.
    fn solve(
        &mut self,
        points: &Points,
        axis: usize,
        polygon: &[u32],
        turn: Sign,
        wanted: &dyn Fn(u32, u32) -> bool,
    ) -> Result<(), Error> {
        let n = polygon.len();
        self.cost.clear();
        fallible::resize(&mut self.cost, n * n, 0.0)?;
        self.apex.clear();
        fallible::resize(&mut self.apex, n * n, 0)?;
        for length in 2..n - 1 {
            for i in 0..n - length {
                let j = i + length;
                let mut best = (f64::INFINITY, 0);
                for k in i + 1..j {
                    let cost = self.with_apex(points, axis, polygon, turn, [i, k, j]);
                    if cost < best.0 {
                        best = (cost, k);
                    }
                }
                let bonus = if wanted(polygon[i], polygon[j]) { BONUS } else { 0.0 };
                self.cost[i * n + j] = best.0 - bonus;
                self.apex[i * n + j] = best.1 as u8;
            }
        }
        Ok(())
    }

    fn with_apex(
        &self,
        points: &Points,
        axis: usize,
        polygon: &[u32],
        turn: Sign,
        [i, k, j]: [usize; 3],
    ) -> f64 {
        let n = polygon.len();
        let parts = self.cost[i * n + k] + self.cost[k * n + j];
        if !parts.is_finite() || points.orient_in_plane(axis, polygon[i], polygon[k], polygon[j]) != turn {
            return f64::INFINITY;
        }
        parts + shape(points, [polygon[i], polygon[k], polygon[j]])
    }

    fn collect(&mut self, polygon: &[u32]) -> Result<Vec<[u32; 3]>, Error> {
        let n = polygon.len();
        let mut triangles = fallible::reserved(n)?;
        self.stack.clear();
        self.stack.try_reserve(2 * n)?;
        fallible::push(&mut self.stack, (0, n - 1))?;
        while let Some((i, j)) = self.stack.pop() {
            if j - i < 2 {
                continue;
            }
            let k = self.apex[i * n + j] as usize;
            fallible::push(&mut triangles, [polygon[i], polygon[k], polygon[j]])?;
            fallible::push(&mut self.stack, (i, k))?;
            fallible::push(&mut self.stack, (k, j))?;
        }
        Ok(triangles)
    }
}

/// Which way the polygon turns: its first edge and last corner make a triangle that does.
fn turn(points: &Points, axis: usize, polygon: &[u32]) -> Option<Sign> {
    let sign = points.orient_in_plane(axis, polygon[0], polygon[1], polygon[polygon.len() - 1]);
    (sign != Sign::Zero).then_some(sign)
}

/// Square of the circumradius times perimeter over area, about: large for triangles that are long or flat.
fn shape(points: &Points, corners: [u32; 3]) -> f64 {
    let [p, q, r] = corners.map(|v| points.xyz(v));
    let side = |a: &[f64; 3], b: &[f64; 3]| [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
    let (u, v, w) = (side(p, q), side(q, r), side(r, p));
    let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let squares = dot(&u, &u) + dot(&v, &v) + dot(&w, &w);
    (squares / dot(&n, &n).sqrt().max(f64::MIN_POSITIVE)).min(1e4)
}

/// A triangulation by cutting ears that hold no other corner.
fn clip_ears(
    points: &Points,
    axis: usize,
    polygon: &[u32],
    turn: Sign,
) -> Result<Option<Vec<[u32; 3]>>, Error> {
    let mut left: Vec<u32> = fallible::copied(polygon)?;
    let mut triangles = fallible::reserved(polygon.len())?;
    let mut at = 0;
    let mut refused = 0;
    while left.len() > 3 {
        let n = left.len();
        let (a, b, c) = (left[(at + n - 1) % n], left[at % n], left[(at + 1) % n]);
        let is_turn = |x, y, z| points.orient_in_plane(axis, x, y, z) == turn;
        let against = |x, y, z| points.orient_in_plane(axis, x, y, z) == -turn;
        let ear = is_turn(a, b, c)
            && left.iter().all(|&v| {
                v == a || v == b || v == c || against(a, b, v) || against(b, c, v) || against(c, a, v)
            });
        if ear {
            fallible::push(&mut triangles, [a, b, c])?;
            left.remove(at % n);
            refused = 0;
        } else {
            refused += 1;
            if refused > n {
                return Ok(None);
            }
        }
        at = (at + 1) % left.len();
    }
    let [a, b, c] = [left[0], left[1], left[2]];
    if points.orient_in_plane(axis, a, b, c) != turn {
        return Ok(None);
    }
    fallible::push(&mut triangles, [a, b, c])?;
    Ok(Some(triangles))
}
