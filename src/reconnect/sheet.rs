//! Removal of an edge by a sheet: the ring of an edge `p q` is filled without it by triangulating its link.
//!
//! Every triangle of the link polygon's triangulation is joined to `p` and to `q`; both tetrahedra must be positive. The best
//! triangulation is found by dynamic programming over the polygon (Klincsek 1980; for edges of tetrahedra Shewchuk 2002, "Two
//! discrete optimization algorithms for the topological improvement of tetrahedral meshes"): best is the one with the best
//! worst tetrahedron. The flips 3-2 and 4-4 are the cases of three and four tetrahedra. Where the way from one point to another shall become
//! clear, that comes first: best are the triangulations of which fewest tetrahedra meet it.
//!
//! Signs are exact; quality and the tetrahedra on the way are plain arithmetic and only choose among valid sheets.
use super::quality::quality;
use super::shape::{Goal, Shape};
use crate::error::Error;
use crate::predicates::{Points, Sign};
use crate::vector::{cross, dot, sub};

/// Most tetrahedra round an edge: the number of triangles grows with the cube.
pub const MOST_IN_RING: usize = 64;

/// The best triangulation of a part of the polygon.
#[derive(Clone, Copy)]
struct Best {
    /// Its worst quality; not above what is asked for: there is none.
    worst: f64,
    /// How many of its tetrahedra are on the way.
    met: u32,
    /// The apex on its chord.
    apex: u8,
}

/// Finds sheets; keeps its scratch space.
#[derive(Default)]
pub struct Sheets {
    /// Per part `i..=j` of the polygon.
    best: Vec<Best>,
    stack: Vec<(u8, u8)>,
}

impl Sheets {
    /// Appends the tetrahedra that fill the ring of `p q` without this edge, or returns false: no sheet does. `link`: the polygon
    /// such that `(p, q, link[i], link[i + 1])` is positive. With `ear`, the sheet must have the triangle of the last vertex and its
    /// neighbours.
    pub fn fill(
        &mut self,
        points: &Points,
        [p, q]: [u32; 2],
        link: &[u32],
        ear: bool,
        tets: &mut Vec<[u32; 4]>,
    ) -> Result<bool, Error> {
        self.plan(link, ear, 0.0, |triangle| (worth(points, [p, q], triangle), 0), [p, q], tets)
    }

    /// As [`Sheets::fill`] without an ear; of the tetrahedra as few as possible shall meet the way from `a` to `b`.
    pub fn clear(
        &mut self,
        points: &Points,
        [p, q]: [u32; 2],
        link: &[u32],
        [a, b]: [u32; 2],
        tets: &mut Vec<[u32; 4]>,
    ) -> Result<bool, Error> {
        let on_way = |[x, y, z]: [u32; 3]| {
            let worth = worth(points, [p, q], [x, y, z]);
            let meets = |v: u32| u32::from(meets(points, [a, b], [x, y, z, v]));
            (worth, if worth > 0.0 { meets(q) + meets(p) } else { 0 })
        };
        self.plan(link, false, 0.0, on_way, [p, q], tets)
    }

    /// As [`Sheets::fill`], but the tetrahedra must reach a goal.
    pub fn improve(
        &mut self,
        points: &Points,
        [p, q]: [u32; 2],
        link: &[u32],
        goal: &Goal,
        tets: &mut Vec<[u32; 4]>,
    ) -> Result<bool, Error> {
        let worth = |[a, b, c]: [u32; 3]| {
            let above = goal.worth(Shape::of(points, [a, b, c, q]));
            let worse = if above > goal.above {
                above.min(goal.worth(Shape::of(points, [b, a, c, p])))
            } else {
                above
            };
            // Signs last: hardly any triangle gets here.
            let valid = worse > goal.above && is_positive(points, [p, q], [a, b, c]);
            (if valid { worse } else { -1.0 }, 0)
        };
        self.plan(link, false, goal.above, worth, [p, q], tets)
    }

    /// Finds the best triangulation of the polygon whose triangles are worth more than `above`, and appends its tetrahedra. `worth`: of
    /// a triangle, and how many of its tetrahedra are on the way.
    fn plan(
        &mut self,
        link: &[u32],
        ear: bool,
        above: f64,
        worth: impl Fn([u32; 3]) -> (f64, u32),
        [p, q]: [u32; 2],
        tets: &mut Vec<[u32; 4]>,
    ) -> Result<bool, Error> {
        let n = link.len();
        if !(3..=MOST_IN_RING).contains(&n) {
            return Ok(false);
        }
        self.best.clear();
        self.best.try_reserve(n * n)?;
        self.best.resize(n * n, Best { worst: f64::INFINITY, met: 0, apex: 0 });
        for width in 2..n {
            for i in 0..n - width {
                let j = i + width;
                let mut best = Best { worst: above, met: u32::MAX, apex: 0 };
                let from = if ear && width == n - 1 { j - 1 } else { i + 1 };
                for k in from..j {
                    let (left, right) = (self.best[i * n + k], self.best[k * n + j]);
                    let (rest, met) = (left.worst.min(right.worst), left.met.saturating_add(right.met));
                    if rest <= above || met > best.met || (met == best.met && rest <= best.worst) {
                        continue;
                    }
                    let (worth, on_way) = worth([link[i], link[k], link[j]]);
                    let (worst, met) = (rest.min(worth), met + on_way);
                    if worst > above && (met < best.met || (met == best.met && worst > best.worst)) {
                        best = Best { worst, met, apex: k as u8 };
                    }
                }
                self.best[i * n + j] = best;
            }
        }
        if self.best[n - 1].worst <= above {
            return Ok(false);
        }
        tets.try_reserve(2 * (n - 2))?;
        self.stack.clear();
        self.stack.try_reserve(n)?;
        self.stack.push((0, n as u8 - 1));
        while let Some((i, j)) = self.stack.pop() {
            if j - i < 2 {
                continue;
            }
            let k = self.best[i as usize * n + j as usize].apex;
            let [a, b, c] = [i, k, j].map(|at| link[at as usize]);
            tets.extend([[a, b, c, q], [b, a, c, p]]);
            self.stack.extend([(i, k), (k, j)]);
        }
        Ok(true)
    }
}

/// Both tetrahedra at a triangle of a sheet are positive.
fn is_positive(points: &Points, [p, q]: [u32; 2], [a, b, c]: [u32; 3]) -> bool {
    points.orient3d(a, b, c, q) == Sign::Positive && points.orient3d(b, a, c, p) == Sign::Positive
}

/// The worse quality of the two tetrahedra at a triangle of a sheet, or −1 if one is not positive.
fn worth(points: &Points, [p, q]: [u32; 2], [a, b, c]: [u32; 3]) -> f64 {
    if !is_positive(points, [p, q], [a, b, c]) {
        return -1.0;
    }
    let at = |v: u32| points.xyz(v);
    let worse = quality([at(a), at(b), at(c), at(q)]).min(quality([at(b), at(a), at(c), at(p)]));
    // However flat in plain arithmetic, it is a sheet.
    worse.max(f64::MIN_POSITIVE)
}

/// Whether the way from one point to another passes through a tetrahedron; in plain arithmetic.
fn meets(points: &Points, [a, b]: [u32; 2], corners: [u32; 4]) -> bool {
    let (mut from, mut to) = (0.0f64, 1.0f64);
    for i in 0..4 {
        let face = [1, 2, 3].map(|k| corners[(i + k) % 4]);
        let [x, y, z] = face.map(|v| points.xyz(v));
        let normal = cross(&sub(y, x), &sub(z, x));
        let side = |v: u32| if face.contains(&v) { 0.0 } else { dot(&normal, &sub(points.xyz(v), x)) };
        let inward = side(corners[i]).signum();
        let (at_a, at_b) = (inward * side(a), inward * side(b));
        if at_a <= 0.0 && at_b <= 0.0 {
            return false;
        }
        let crossing = at_a / (at_a - at_b);
        if at_a < 0.0 {
            from = from.max(crossing);
        } else if at_b < 0.0 {
            to = to.min(crossing);
        }
    }
    from < to
}
