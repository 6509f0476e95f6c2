//! Orientation in space, and signs of low degree: order, dot product, collinearity.

use crate::predicates::big::Big;
use crate::predicates::{
    differences, exact, filter, located, robust_orient3d, wide, Expansion, Points, Sign,
};
use std::cmp::Ordering;

/// A plane through three points `b`, `c`, `d`, rounded.
#[derive(Clone, Copy, Debug)]
pub struct Plane {
    at: [f64; 3],
    normal: [f64; 3],
    bound: f64,
}

impl Plane {
    /// `orient3d(a, b, c, d)` for the point with these coordinates (the nearest doubles of an implicit point), if the static filter
    /// decides. The determinant has the monomials and roundings that [`filter`] counts, relative to `b`, so its bound holds.
    #[inline(always)]
    pub fn side(&self, a: &[f64; 3]) -> Option<Sign> {
        let (p, n) = (&self.at, &self.normal);
        let det = (p[0] - a[0]) * n[0] + (p[1] - a[1]) * n[1] + (p[2] - a[2]) * n[2];
        if det > self.bound {
            Some(Sign::Positive)
        } else if det < -self.bound {
            Some(Sign::Negative)
        } else {
            None
        }
    }
}

impl Points {
    /// Sign of `det(b − a, c − a, d − a)`: positive when the tetrahedron `(a, b, c, d)` is.
    #[inline(always)]
    pub fn orient3d(&self, a: u32, b: u32, c: u32, d: u32) -> Sign {
        let det = filter::orient3d_det(self.xyz(a), self.xyz(b), self.xyz(c), self.xyz(d));
        if det > self.orient3d_bound {
            Sign::Positive
        } else if det < -self.orient3d_bound {
            Sign::Negative
        } else {
            self.orient3d_close(det, [a, b, c, d])
        }
    }

    /// Sign of `det(b − a, c − a, d − a)` for a point `a` with any finite coordinates, given as `a = p 2^exponent`. Slow: for points
    /// outside the exact range.
    pub fn orient3d_of(&self, p: &[f64; 3], exponent: i32, [b, c, d]: [u32; 3]) -> Sign {
        let [b, c, d] = [b, c, d].map(|v| self.exact_coordinates(v));
        exact::orient3d_far(&Big::scaled_rows(&[p.map(Expansion::from), b, c, d], [exponent, 0, 0, 0]))
    }

    /// The plane through three points, for repeated calls of [`Plane::side`].
    #[inline]
    pub fn plane(&self, b: u32, c: u32, d: u32) -> Plane {
        let (b, c, d) = (self.xyz(b), self.xyz(c), self.xyz(d));
        let (px, py, pz) = (c[0] - b[0], c[1] - b[1], c[2] - b[2]);
        let (qx, qy, qz) = (d[0] - b[0], d[1] - b[1], d[2] - b[2]);
        let normal = [py * qz - pz * qy, pz * qx - px * qz, px * qy - py * qx];
        Plane { at: *b, normal, bound: self.orient3d_bound }
    }

    /// The semi-static filter.
    #[inline(never)]
    fn orient3d_close(&self, det: f64, ids: [u32; 4]) -> Sign {
        let explicit = !self.any_implicit(&ids);
        let spread = self.spread(ids, explicit);
        if spread.flat() {
            return Sign::Zero;
        }
        if det.abs() > spread.orient3d_bound() && (explicit || !self.any_fine(&ids)) {
            return Sign::of(det);
        }
        self.orient3d_exact(det, spread.max(), explicit, ids)
    }

    /// The exact level; `size` bounds all differences.
    #[cold]
    #[inline(never)]
    fn orient3d_exact(&self, det: f64, size: f64, explicit: bool, ids: [u32; 4]) -> Sign {
        if !explicit {
            return self.orient3d_implicit(ids);
        }
        // Differences are integers up to 2^16 in units of the grid: no operation in the determinant rounds.
        if size <= self.grid() * 65536.0 {
            return Sign::of(det);
        }
        let points @ [a, b, c, d] = ids.map(|i| self.xyz(i));
        if let Some(rows) = wide::short_differences(points, size) {
            return wide::short_orient3d(&rows);
        }
        match differences(points) {
            Some(rows) => wide::orient3d(&rows),
            None => robust_orient3d(a, b, c, d),
        }
    }

    #[inline(never)]
    fn orient3d_implicit(&self, ids: [u32; 4]) -> Sign {
        if self.coplanar_by_position(ids) {
            return Sign::Zero;
        }
        let points = self.located(ids);
        match located::differences(&points) {
            Some(rows) => wide::orient3d(&rows),
            None => exact::orient3d(&self.big(points)),
        }
    }

    /// Sign of `(b − a)·(c − a)`.
    pub fn dot_sign(&self, a: u32, b: u32, c: u32) -> Sign {
        let ids = [b, c, a];
        let (pa, pb, pc) = (self.xyz(a), self.xyz(b), self.xyz(c));
        let dot: f64 = (0..3).map(|i| (pb[i] - pa[i]) * (pc[i] - pa[i])).sum();
        if !self.any_fine(&ids) && dot.abs() > self.spread(ids, !self.any_implicit(&ids)).dot_bound() {
            return Sign::of(dot);
        }
        let points = self.located(ids);
        match located::differences(&points) {
            Some(rows) => wide::dot_sign(&rows),
            None => exact::dot_sign(&self.big(self.located([a, b, c]))),
        }
    }

    /// Whether three points lie on one line.
    pub fn collinear(&self, a: u32, b: u32, c: u32) -> bool {
        (0..3).all(|axis| self.orient_in_plane(axis, a, b, c) == Sign::Zero)
    }

    /// Lexicographic order of the exact coordinates.
    pub fn compare_lex(&self, a: u32, b: u32) -> Ordering {
        let known = self.is_explicit(a) && self.is_explicit(b);
        for axis in 0..3 {
            // Rounding to nearest is monotone: different doubles decide.
            let mut order = compare(self.xyz(a)[axis], self.xyz(b)[axis]);
            if order.is_eq() && !known {
                // Expansions cannot underflow here: Steiner points have no bits below 2^-1014, and neither have differences.
                let sign = match self.short_coordinates(&self.located([a, b])) {
                    Some([p, q]) => p[axis].difference(&q[axis]).sign(),
                    None => {
                        let [p, q] = [a, b].map(|i| self.exact_coordinates(i));
                        p[axis].difference(&q[axis]).sign()
                    }
                };
                order = sign.cmp(&Sign::Zero);
            }
            if order.is_ne() {
                return order;
            }
        }
        Ordering::Equal
    }

    /// Whether two points are equal in exact coordinates.
    pub fn same_position(&self, a: u32, b: u32) -> bool {
        a == b || (self.xyz(a) == self.xyz(b) && self.compare_lex(a, b).is_eq())
    }
}

/// Order of two finite doubles; zeros of both signs are equal.
fn compare(x: f64, y: f64) -> Ordering {
    debug_assert!(x.is_finite() && y.is_finite());
    x.partial_cmp(&y).unwrap_or(Ordering::Equal)
}
