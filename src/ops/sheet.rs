//! Removal of an edge by a sheet: the ring of an edge `p q` is filled without it by triangulating its link.
//!
//! Every triangle of the link polygon's triangulation is joined to `p` and to `q`; both tetrahedra must be positive. The best
//! triangulation is found by dynamic programming over the polygon (Klincsek 1980; for edges of tetrahedra Shewchuk 2002, "Two
//! discrete optimization algorithms for the topological improvement of tetrahedral meshes"): the best one has the best worst tetrahedron.
//! The flips 3-2 and 4-4 are the cases of three and four tetrahedra. If the segment between two points is to be cleared, that takes
//! precedence: the best triangulations are those with the fewest tetrahedra that meet it.
//!
//! Signs are exact; quality, and which tetrahedra meet the segment, are floating-point and only choose among valid sheets.
use crate::error::Error;
use crate::fallible;
use crate::ops::quality::quality;
use crate::ops::shape::{Goal, Shape};
use crate::predicates::{Points, Sign};
use crate::vector::{cross, dot, sub};

/// The most tetrahedra around an edge: the number of triangles grows with its cube. Sets of vertices are bits of one word, so it cannot be
/// larger. 32 changes nothing on eleven models: it only bounds the work on worse ones.
pub const MOST_IN_RING: usize = 64;

/// The best triangulation of a part of the polygon.
#[derive(Clone, Copy)]
struct Best {
    /// Its worst quality; there is no triangulation if this is not above the required one.
    worst: f64,
    /// How many of its tetrahedra meet the segment.
    met: u32,
    /// The apex on its chord.
    apex: u8,
}

/// Finds sheets; keeps its scratch space.
#[derive(Default)]
pub struct Sheets {
    /// For each part `i..=j` of the polygon the apexes on its chord with which it can be triangulated.
    apexes: Vec<u64>,
    /// For each part its best triangulation.
    best: Vec<Best>,
    stack: Vec<(u8, u8)>,
}

impl Sheets {
    /// Appends the tetrahedra that fill the ring of `p q` without this edge; returns false if no sheet does. `link` is the polygon such
    /// that `(p, q, link[i], link[i + 1])` is positive. With `ear`, the sheet must have the triangle of the last vertex and its neighbours.
    pub fn fill(
        &mut self,
        points: &Points,
        [p, q]: [u32; 2],
        link: &[u32],
        ear: bool,
        tets: &mut Vec<[u32; 4]>,
    ) -> Result<bool, Error> {
        let n = link.len();
        if !(3..=MOST_IN_RING).contains(&n) || !self.find_apexes(points, [p, q], link, ear)? {
            return Ok(false);
        }
        if n == 3 {
            let [a, b, c] = [0, 1, 2].map(|i| link[i]);
            fallible::extend(tets, [[a, b, c, q], [b, a, c, p]])?;
            return Ok(true);
        }
        self.plan_valid(points, link, ear, |_| 0, [p, q], tets)
    }

    /// Like [`Sheets::fill`] without an ear, with as few tetrahedra as possible that meet the segment from `a` to `b`.
    pub fn clear(
        &mut self,
        points: &Points,
        [p, q]: [u32; 2],
        link: &[u32],
        [a, b]: [u32; 2],
        tets: &mut Vec<[u32; 4]>,
    ) -> Result<bool, Error> {
        if !(3..=MOST_IN_RING).contains(&link.len()) || !self.find_apexes(points, [p, q], link, false)? {
            return Ok(false);
        }
        let on_way = |[x, y, z]: [u32; 3]| {
            let meets = |v: u32| u32::from(meets(points, [a, b], [x, y, z, v]));
            meets(q) + meets(p)
        };
        self.plan_valid(points, link, false, on_way, [p, q], tets)
    }

    /// Plans with the triangles found by [`Sheets::find_apexes`].
    fn plan_valid(
        &mut self,
        points: &Points,
        link: &[u32],
        ear: bool,
        on_way: impl Fn([u32; 3]) -> u32,
        ends: [u32; 2],
        tets: &mut Vec<[u32; 4]>,
    ) -> Result<bool, Error> {
        let n = link.len();
        let apexes = std::mem::take(&mut self.apexes);
        let rate = |[i, k, j]: [usize; 3]| {
            if apexes[i * n + j] >> k & 1 == 1 {
                let triangle = [i, k, j].map(|at| link[at]);
                (worse_quality(points, ends, triangle), on_way(triangle))
            } else {
                (-1.0, 0)
            }
        };
        let found = self.plan(link, ear, 0.0, rate, ends, tets);
        self.apexes = apexes;
        found
    }

    /// Finds all triangles that triangulations may have, by signs alone: usually there are none, and no quality is needed.
    fn find_apexes(
        &mut self,
        points: &Points,
        ends: [u32; 2],
        link: &[u32],
        ear: bool,
    ) -> Result<bool, Error> {
        let n = link.len();
        if ear && !is_positive(points, ends, [link[0], link[n - 2], link[n - 1]]) {
            return Ok(false);
        }
        let apexes = &mut self.apexes;
        apexes.clear();
        // Sides of the polygon need no apex.
        fallible::resize(apexes, n * n, u64::MAX)?;
        for (i, j) in chords(n, ear) {
            let mut set = 0;
            for k in first_apex(n, ear, [i, j])..j {
                if apexes[i * n + k] != 0
                    && apexes[k * n + j] != 0
                    && ((ear && j == n - 1) || is_positive(points, ends, [link[i], link[k], link[j]]))
                {
                    set |= 1 << k;
                }
            }
            apexes[i * n + j] = set;
        }
        Ok(apexes[n - 1] != 0)
    }

    /// Like [`Sheets::fill`], but the tetrahedra must reach a goal.
    pub fn improve(
        &mut self,
        points: &Points,
        [p, q]: [u32; 2],
        link: &[u32],
        goal: &Goal,
        tets: &mut Vec<[u32; 4]>,
    ) -> Result<bool, Error> {
        let rate = |at: [usize; 3]| {
            let [a, b, c] = at.map(|i| link[i]);
            let above = goal.quality(Shape::of(points, [a, b, c, q]));
            let worse = if above > goal.above {
                above.min(goal.quality(Shape::of(points, [b, a, c, p])))
            } else {
                above
            };
            // Signs last, since hardly any triangle gets here.
            let valid = worse > goal.above && is_positive(points, [p, q], [a, b, c]);
            (if valid { worse } else { -1.0 }, 0)
        };
        self.plan(link, false, goal.above, rate, [p, q], tets)
    }

    /// Finds the best triangulation of the polygon whose triangles have tetrahedra better than `above`, and appends its tetrahedra. `rate` gives
    /// the quality of the worse tetrahedron at a triangle and how many of its tetrahedra meet the segment.
    fn plan(
        &mut self,
        link: &[u32],
        ear: bool,
        above: f64,
        rate: impl Fn([usize; 3]) -> (f64, u32),
        [p, q]: [u32; 2],
        tets: &mut Vec<[u32; 4]>,
    ) -> Result<bool, Error> {
        let n = link.len();
        if !(3..=MOST_IN_RING).contains(&n) {
            return Ok(false);
        }
        self.best.clear();
        fallible::resize(&mut self.best, n * n, Best { worst: f64::INFINITY, met: 0, apex: 0 })?;
        for (i, j) in chords(n, ear) {
            let mut best = Best { worst: above, met: u32::MAX, apex: 0 };
            for k in first_apex(n, ear, [i, j])..j {
                let (left, right) = (self.best[i * n + k], self.best[k * n + j]);
                let (rest, met) = (left.worst.min(right.worst), left.met.saturating_add(right.met));
                if rest <= above || met > best.met || (met == best.met && rest <= best.worst) {
                    continue;
                }
                let (worse, on_way) = rate([i, k, j]);
                let (worst, met) = (rest.min(worse), met + on_way);
                if worst > above && (met < best.met || (met == best.met && worst > best.worst)) {
                    best = Best { worst, met, apex: k as u8 };
                }
            }
            self.best[i * n + j] = best;
        }
        if self.best[n - 1].worst <= above {
            return Ok(false);
        }
        tets.try_reserve(2 * (n - 2))?;
        self.stack.clear();
        self.stack.try_reserve(n)?;
        fallible::push(&mut self.stack, (0, n as u8 - 1))?;
        while let Some((i, j)) = self.stack.pop() {
            if j - i < 2 {
                continue;
            }
            let k = self.best[i as usize * n + j as usize].apex;
            let [a, b, c] = [i, k, j].map(|at| link[at as usize]);
            fallible::extend(tets, [[a, b, c, q], [b, a, c, p]])?;
            fallible::extend(&mut self.stack, [(i, k), (k, j)])?;
        }
        Ok(true)
    }
}

/// The parts `i..=j` of a polygon whose triangulations are needed, those within others first. With an ear at the last vertex, only the
/// whole polygon has this vertex.
fn chords(n: usize, ear: bool) -> impl Iterator<Item = (usize, usize)> {
    let last = n - usize::from(ear);
    let parts = (2..last).flat_map(move |width| (0..last - width).map(move |i| (i, i + width)));
    parts.chain(ear.then_some((0, n - 1)))
}

/// The first apex that the chord of a part may have.
fn first_apex(n: usize, ear: bool, [i, j]: [usize; 2]) -> usize {
    if ear && [i, j] == [0, n - 1] {
        j - 1
    } else {
        i + 1
    }
}

/// Whether both tetrahedra at a triangle of a sheet are positive.
fn is_positive(points: &Points, [p, q]: [u32; 2], [a, b, c]: [u32; 3]) -> bool {
    points.orient3d(a, b, c, q) == Sign::Positive && points.orient3d(b, a, c, p) == Sign::Positive
}

/// The worse quality of the two tetrahedra at a triangle of a sheet, both positive.
fn worse_quality(points: &Points, [p, q]: [u32; 2], [a, b, c]: [u32; 3]) -> f64 {
    let at = |v: u32| points.xyz(v);
    let worse = quality([at(a), at(b), at(c), at(q)]).min(quality([at(b), at(a), at(c), at(p)]));
    // However flat in floating point, it is a valid sheet.
    worse.max(f64::MIN_POSITIVE)
}

/// Whether the segment between two points passes through a tetrahedron, in floating-point arithmetic.
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
        // The signs differ, so there is no division by zero.
        if at_a < 0.0 {
            from = from.max(at_a / (at_a - at_b));
        } else if at_b < 0.0 {
            to = to.min(at_a / (at_a - at_b));
        }
    }
    from < to
}
