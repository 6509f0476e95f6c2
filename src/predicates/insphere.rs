//! The insphere sign by point index, unperturbed and perturbed.
//!
//! Perturbation: the lift of the vertex with the lowest id is lowered infinitesimally, that of the next one by infinitely less, and so on.
//! The derivative of the insphere determinant with respect to a lift is the orientation of the other four points, so the first non-zero one
//! in the order of ids decides. Source: Devillers & Teillaud 2011 (perturbation of the lifting only).

use crate::predicates::{differences, exact, filter, located, robust_insphere, wide, Points, Sign};

/// The position of a tetrahedron relative to a point, as far as a quick test tells.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Glance {
    /// Its circumsphere contains the point.
    Inside,
    /// The point is beyond the plane of this face; of such faces, the one with the largest determinant.
    Beyond(u32),
    /// An exact test is needed; if the point is beyond a plane at all, it is close to it.
    Unclear,
}

impl Points {
    /// Positive when `e` is inside the circumsphere of the positive tetrahedron `(a, b, c, d)`, zero if the five are
    /// cospherical (or coplanar); odd under swaps of the first four.
    #[inline(always)]
    pub fn insphere(&self, a: u32, b: u32, c: u32, d: u32, e: u32) -> Sign {
        let det = filter::insphere_det(self.xyz(a), self.xyz(b), self.xyz(c), self.xyz(d), self.xyz(e));
        if det > self.insphere_bound {
            Sign::Positive
        } else if det < -self.insphere_bound {
            Sign::Negative
        } else {
            self.insphere_close(det, [a, b, c, d, e])
        }
    }

    /// Whether [`insphere_perturbed`](Points::insphere_perturbed) is positive; `at` are the coordinates of `e`. There is only one branch,
    /// hardly ever taken: for callers whose branches on the result would be mispredicted.
    #[inline(always)]
    pub fn inside_perturbed(&self, [a, b, c, d]: [u32; 4], e: u32, at: &[f64; 3]) -> bool {
        let det = filter::insphere_det(self.xyz(a), self.xyz(b), self.xyz(c), self.xyz(d), at);
        if det.abs() > self.insphere_bound {
            det > 0.0
        } else {
            self.inside_close(det, [a, b, c, d, e])
        }
    }

    /// The position of a finite tetrahedron relative to `e`, whose coordinates are `at`, as far as the static filter can tell.
    #[inline(always)]
    pub(crate) fn glance(&self, [a, b, c, d]: [u32; 4], at: &[f64; 3]) -> Glance {
        let (sides, det) = filter::insphere_minors(self.xyz(a), self.xyz(b), self.xyz(c), self.xyz(d), at);
        if det > self.insphere_bound {
            return Glance::Inside;
        }
        self.beyond(sides)
    }

    /// The face that a point is beyond, by the minors of its determinant.
    #[inline(always)]
    pub(super) fn beyond(&self, sides: [f64; 4]) -> Glance {
        // Branch-free, since which face it is cannot be predicted.
        let first = (sides[1] < sides[0]) as usize;
        let second = 2 + (sides[3] < sides[2]) as usize;
        let least = if sides[second] < sides[first] { second } else { first };
        if sides[least] < -self.orient3d_bound {
            Glance::Beyond(least as u32)
        } else {
            Glance::Unclear
        }
    }

    #[inline(never)]
    fn inside_close(&self, det: f64, ids: [u32; 5]) -> bool {
        let sign = match self.insphere_close(det, ids) {
            Sign::Zero => self.insphere_tie(ids),
            sign => sign,
        };
        sign == Sign::Positive
    }

    /// The semi-static filter.
    #[inline(never)]
    fn insphere_close(&self, det: f64, ids: [u32; 5]) -> Sign {
        let explicit = !self.any_implicit(&ids);
        let spread = self.spread(ids, explicit);
        if spread.flat() {
            return Sign::Zero;
        }
        if det.abs() > spread.insphere_bound() && (explicit || !self.any_fine(&ids)) {
            return Sign::of(det);
        }
        self.insphere_exact(det, spread.max(), explicit, ids)
    }

    /// The exact level; `size` bounds all differences.
    #[cold]
    #[inline(never)]
    fn insphere_exact(&self, det: f64, size: f64, explicit: bool, ids: [u32; 5]) -> Sign {
        if !explicit {
            return self.insphere_implicit(ids);
        }
        // Differences are integers up to 2^9 in units of the grid: at most 72 monomials of at most 2^45, nothing rounds.
        if size <= self.grid() * 512.0 {
            return Sign::of(det);
        }
        let points @ [a, b, c, d, e] = ids.map(|i| self.xyz(i));
        if let Some(rows) = wide::short_differences(points, size) {
            return wide::short_insphere(&rows);
        }
        match differences(points) {
            Some(rows) => wide::insphere(&rows),
            None => robust_insphere(a, b, c, d, e),
        }
    }

    #[inline(never)]
    fn insphere_implicit(&self, ids: [u32; 5]) -> Sign {
        let points = self.located(ids);
        if let Some(rows) = located::differences(&points) {
            return wide::insphere(&rows);
        }
        located::insphere_leading(&points).unwrap_or_else(|| exact::insphere(&self.big(points)))
    }

    /// [`insphere`](Points::insphere), with ties broken by the perturbation: never zero for five distinct points that
    /// are not all coplanar.
    #[inline(always)]
    pub fn insphere_perturbed(&self, a: u32, b: u32, c: u32, d: u32, e: u32) -> Sign {
        match self.insphere(a, b, c, d, e) {
            Sign::Zero => self.insphere_tie([a, b, c, d, e]),
            sign => sign,
        }
    }

    #[cold]
    #[inline(never)]
    pub(super) fn insphere_tie(&self, mut ids: [u32; 5]) -> Sign {
        let mut odd = sort_parity(&mut ids);
        for skipped in 0..5 {
            let mut rest = [0; 4];
            let others = (0..5).filter(|&i| i != skipped);
            for (to, from) in rest.iter_mut().zip(others) {
                *to = ids[from];
            }
            let sign = self.orient3d(rest[0], rest[1], rest[2], rest[3]);
            if sign != Sign::Zero {
                return if odd { -sign } else { sign };
            }
            odd = !odd;
        }
        Sign::Zero
    }
}

/// Sorts; returns whether the permutation was odd.
fn sort_parity<const N: usize>(ids: &mut [u32; N]) -> bool {
    let mut odd = false;
    for end in (1..N).rev() {
        for i in 0..end {
            if ids[i] > ids[i + 1] {
                ids.swap(i, i + 1);
                odd = !odd;
            }
        }
    }
    odd
}
