//! Signs in a coordinate projection, for the triangulation of facets.
//!
//! The projection drops one axis and keeps the coordinates (axis + 1) mod 3 and (axis + 2) mod 3 in this order.

use crate::predicates::filter::Spread;
use crate::predicates::located::Located;
use crate::predicates::{exact, located, wide, Points, Sign};

impl Points {
    /// Positive when `a`, `b`, `c` make a left turn in the projection that drops `axis` (0 to 2).
    pub fn orient_in_plane(&self, axis: usize, a: u32, b: u32, c: u32) -> Sign {
        self.orient_in_plane_of(axis, self.located([a, b, c]))
    }

    /// [`orient_in_plane`](Points::orient_in_plane) for points that need not be in the store.
    #[inline(always)]
    pub(super) fn orient_in_plane_of(&self, axis: usize, points: [Located; 3]) -> Sign {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let [pa, pb, pc] = points.map(|p| p.xyz);
        let det = (pa[u] - pc[u]) * (pb[v] - pc[v]) - (pa[v] - pc[v]) * (pb[u] - pc[u]);
        let mut spread = Spread::of([pa, pb, pc]);
        if points.iter().any(|p| p.implicit.is_some()) {
            located::widen(&mut spread, &points);
        }
        if spread.size[u] == 0.0 || spread.size[v] == 0.0 {
            return Sign::Zero;
        }
        if !points.iter().any(|p| p.fine()) && det.abs() > spread.orient2d_bound(u, v) {
            return Sign::of(det);
        }
        match located::differences(&points) {
            Some(rows) => wide::orient2d(&rows, u, v),
            None => exact::orient2d(&self.big(points), u, v),
        }
    }

    /// For exactly coplanar points with `(a, b, c)` positive in the projection that drops `axis`: positive when `d` is
    /// inside the circle through `a`, `b`, `c` in space (not in the projection).
    ///
    /// Ties are broken as in [`insphere_perturbed`](Points::insphere_perturbed): with any point `e` off the plane the result is the
    /// perturbed sign of `(a, b, c, e; d)`, or of `(b, a, c, e; d)`, whichever tetrahedron is positive. Zero only if `a`, `b`, `c` are
    /// collinear.
    pub fn incircle_in_plane(&self, axis: usize, a: u32, b: u32, c: u32, d: u32) -> Sign {
        match self.incircle_unperturbed(axis, [a, b, c, d]) {
            Sign::Zero => self.incircle_tie(axis, [a, b, c, d]),
            sign => sign,
        }
    }

    /// Whether four exactly coplanar points, no three of them collinear, lie on a circle.
    pub fn cocircular(&self, a: u32, b: u32, c: u32, d: u32) -> bool {
        (0..3)
            .find(|&axis| self.orient_in_plane(axis, a, b, c) != Sign::Zero)
            .is_some_and(|axis| self.incircle_unperturbed(axis, [a, b, c, d]) == Sign::Zero)
    }

    fn incircle_unperturbed(&self, axis: usize, ids: [u32; 4]) -> Sign {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let [a, b, c, d] = ids.map(|i| self.xyz(i));
        let rows = [a, b, c].map(|p| {
            let [x, y, z] = [p[0] - d[0], p[1] - d[1], p[2] - d[2]];
            (p[u] - d[u], p[v] - d[v], x * x + y * y + z * z)
        });
        let [(au, av, al), (bu, bv, bl), (cu, cv, cl)] = rows;
        let det = al * (bu * cv - bv * cu) + bl * (cu * av - cv * au) + cl * (au * bv - av * bu);
        if det.abs() > self.incircle_bounds[axis] {
            return Sign::of(det);
        }
        let spread = self.spread(ids, !self.any_implicit(&ids));
        if spread.size[u] == 0.0 || spread.size[v] == 0.0 {
            return Sign::Zero;
        }
        if !self.any_fine(&ids) && det.abs() > spread.incircle_bound(u, v) {
            return Sign::of(det);
        }
        let points = self.located(ids);
        match located::differences(&points) {
            Some(rows) => wide::incircle(&rows, u, v),
            None => exact::incircle(&self.big(points), u, v),
        }
    }

    /// The first non-zero derivative in the order of ids. In insphere(a, b, c, e; d) the derivatives by the (lowered)
    /// lifts of a, b, c, d are +(b c e d), −(a c e d), +(a b e d), +(a b c e), each sign that of an orientation in
    /// space; that of e is (a b c d) = 0. With e where (a b c e) is positive, (p q e d) = −(p q d e) has the sign of
    /// −(p q d) in the plane; e on the other side swaps a and b and all signs with them.
    fn incircle_tie(&self, axis: usize, [a, b, c, d]: [u32; 4]) -> Sign {
        let mut terms = [(a, [b, d, c]), (b, [a, c, d]), (c, [a, d, b]), (d, [a, b, c])];
        terms.sort_unstable_by_key(|term| term.0);
        terms
            .iter()
            .map(|(_, [p, q, r])| self.orient_in_plane(axis, *p, *q, *r))
            .find(|&sign| sign != Sign::Zero)
            .unwrap_or(Sign::Zero)
    }
}
