//! Removal of an edge by a sheet: the ring of an edge `p q` is filled without it by triangulating its link.
//!
//! Every triangle of the link polygon's triangulation is joined to `p` and to `q`; both tetrahedra must be positive. The best
//! triangulation is found by dynamic programming over the polygon (Klincsek 1980; for edges of tetrahedra Shewchuk 2002, "Two
//! discrete optimization algorithms for the topological improvement of tetrahedral meshes"): best is the one with the best
//! worst tetrahedron. The flips 3-2 and 4-4 are the cases of three and four tetrahedra.
//!
//! Signs are exact; quality is plain arithmetic and only chooses among valid sheets.
use super::quality::quality;
use super::shape::{Goal, Shape};
use crate::error::Error;
use crate::predicates::{Points, Sign};

/// Most tetrahedra round an edge: the number of triangles grows with the cube.
pub const MOST_IN_RING: usize = 64;

/// Finds sheets; keeps its scratch space.
#[derive(Default)]
pub struct Sheets {
    /// Per part `i..=j` of the polygon the worst quality of its best triangulation (not above what is asked for: none), and the apex on its chord.
    best: Vec<(f64, u8)>,
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
        self.plan(link, ear, 0.0, |triangle| worth(points, [p, q], triangle), [p, q], tets)
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
            if valid {
                worse
            } else {
                -1.0
            }
        };
        self.plan(link, false, goal.above, worth, [p, q], tets)
    }

    /// Finds the best triangulation of the polygon whose triangles are worth more than `above`, and appends its tetrahedra.
    fn plan(
        &mut self,
        link: &[u32],
        ear: bool,
        above: f64,
        worth: impl Fn([u32; 3]) -> f64,
        [p, q]: [u32; 2],
        tets: &mut Vec<[u32; 4]>,
    ) -> Result<bool, Error> {
        let n = link.len();
        if !(3..=MOST_IN_RING).contains(&n) {
            return Ok(false);
        }
        self.best.clear();
        self.best.try_reserve(n * n)?;
        self.best.resize(n * n, (f64::INFINITY, 0));
        for width in 2..n {
            for i in 0..n - width {
                let j = i + width;
                let mut best = (above, 0);
                let from = if ear && width == n - 1 { j - 1 } else { i + 1 };
                for k in from..j {
                    let rest = self.best[i * n + k].0.min(self.best[k * n + j].0);
                    if rest <= best.0 {
                        continue;
                    }
                    let worst = rest.min(worth([link[i], link[k], link[j]]));
                    if worst > best.0 {
                        best = (worst, k as u8);
                    }
                }
                self.best[i * n + j] = best;
            }
        }
        if self.best[n - 1].0 <= above {
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
            let k = self.best[i as usize * n + j as usize].1;
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
