//! A triangle with its corner coordinates, its projection along an axis, and the location of a point of its plane in it.
use crate::predicates::{orient2d, orient3d, Sign};

/// A triangle of the input.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triangle {
    /// Index among the triangles.
    pub(super) index: u32,
    /// The facet it is part of.
    pub(super) facet: u32,
    /// Corner ids. Edge `k` runs from corner `k` to corner `k + 1`.
    pub(super) ids: [u32; 3],
    /// Corner coordinates.
    pub(super) corners: [[f64; 3]; 3],
    /// The projection along roughly the longest component of the normal; `None` if the triangle is degenerate.
    pub(super) projection: Option<Projection>,
}

/// Bound on the relative error of a determinant as [`RoundedPlane::side`] rounds it, relative to the permanent: above (7 + 56 u) u with u =
/// 2^-53, which Shewchuk 1997 (section 4.4, stage A) proves for three minors times differences, in any order of rows.
const FILTER: f64 = 8.0 / 9_007_199_254_740_992.0;

/// Bound on the relative error of a 2D orientation, relative to the sum of the magnitudes of its two products: above (3 + 16 u) u, which
/// Shewchuk 1997 (section 4.2, stage A) proves.
const TURN_FILTER: f64 = 2.5 * f64::EPSILON;

/// Bound on the error of a 2D orientation, as in [`orient2d`], from the sum of the magnitudes of its two products. Values within it are
/// left to exact signs.
#[inline(always)]
pub(super) fn turn_bound(permanent: f64) -> f64 {
    TURN_FILTER * permanent + f64::MIN_POSITIVE
}

/// An input segment, with the coordinates of its ends.
pub(super) struct Segment {
    /// Index among the segments.
    pub(super) index: u32,
    /// Ids of the ends.
    pub(super) ids: [u32; 2],
    /// Coordinates of the ends.
    pub(super) ends: [[f64; 3]; 2],
}

impl Segment {
    pub(super) fn new(points: &[[f64; 3]], index: u32, ids: [u32; 2]) -> Segment {
        Segment { index, ids, ends: ids.map(|v| points[v as usize]) }
    }

    /// Whether a vertex lies strictly inside the segment.
    pub(super) fn holds(&self, id: u32, p: &[f64; 3]) -> bool {
        !self.ids.contains(&id) && strictly_between(p, &self.ends[0], &self.ends[1])
    }
}

impl Triangle {
    pub(super) fn new(points: &[[f64; 3]], index: u32, facet: u32, ids: [u32; 3]) -> Triangle {
        let corners = ids.map(|v| points[v as usize]);
        let RoundedPlane { normal, permanent, .. } = RoundedPlane::of(&corners);
        let longest = (1..3).fold(0, |l, k| if normal[k].abs() > normal[l].abs() { k } else { l });
        // A component of the normal is a turn in the projection: the filter of `orient2d`.
        let projection = if normal[longest].abs() > turn_bound(permanent[longest]) {
            Some(Projection::turning(longest as u8, normal[longest] > 0.0))
        } else {
            Projection::of(&corners)
        };
        Triangle { index, facet, ids, corners, projection }
    }

    /// The side of the plane on which a point lies, exactly.
    #[inline]
    pub(super) fn side(&self, p: &[f64; 3]) -> Sign {
        let (det, bound) = RoundedPlane::of(&self.corners).side(p);
        // With a bound of zero every product vanishes, and so does the sign. This is common in planes perpendicular to an axis.
        if det.abs() > bound || bound == 0.0 {
            return Sign::of(det);
        }
        let [a, b, c] = &self.corners;
        orient3d(a, b, c, p)
    }

    /// The ids of an edge's ends.
    pub(super) fn edge(&self, k: usize) -> [u32; 2] {
        [self.ids[k], self.ids[(k + 1) % 3]]
    }

    /// The ends of an edge.
    pub(super) fn edge_points(&self, k: usize) -> [&[f64; 3]; 2] {
        [&self.corners[k], &self.corners[(k + 1) % 3]]
    }
}

/// The plane of a triangle in rounded arithmetic. Few pairs need it, and computing it is faster than fetching it.
pub(super) struct RoundedPlane<'a> {
    at: &'a [f64; 3],
    normal: [f64; 3],
    /// For each component of the normal, the sum of the magnitudes of the two products whose difference it is.
    permanent: [f64; 3],
}

impl RoundedPlane<'_> {
    #[inline(always)]
    pub(super) fn of(corners: &[[f64; 3]; 3]) -> RoundedPlane<'_> {
        let [a, b, c] = corners;
        let (mut normal, mut permanent) = ([0.0; 3], [0.0; 3]);
        for k in 0..3 {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            let (plus, minus) = ((b[i] - a[i]) * (c[j] - a[j]), (b[j] - a[j]) * (c[i] - a[i]));
            normal[k] = plus - minus;
            permanent[k] = plus.abs() + minus.abs();
        }
        RoundedPlane { at: a, normal, permanent }
    }

    /// The determinant whose sign is the side of a point, rounded, and a bound on its error.
    #[inline(always)]
    pub(super) fn side(&self, p: &[f64; 3]) -> (f64, f64) {
        let d = [p[0] - self.at[0], p[1] - self.at[1], p[2] - self.at[2]];
        let (n, m) = (&self.normal, &self.permanent);
        let det = d[0] * n[0] + d[1] * n[1] + d[2] * n[2];
        let permanent = d[0].abs() * m[0] + d[1].abs() * m[1] + d[2].abs() * m[2];
        (det, FILTER * permanent)
    }
}

/// A projection along an axis in which a triangle keeps an area and turns left.
#[derive(Clone, Copy, Debug)]
pub(super) struct Projection {
    // Bytes, so that a triangle fits in little more than two cache lines.
    x: u8,
    y: u8,
}

impl Projection {
    /// The projection for a triangle; `None` if it is degenerate.
    pub(super) fn of(corners: &[[f64; 3]; 3]) -> Option<Projection> {
        (0..3).find_map(|axis| Projection::along(axis, corners))
    }

    /// The projection along one axis; `None` if the triangle has no area in it.
    fn along(axis: u8, corners: &[[f64; 3]; 3]) -> Option<Projection> {
        let [a, b, c] = corners;
        match Projection::turning(axis, true).turn(a, b, c) {
            Sign::Zero => None,
            sign => Some(Projection::turning(axis, sign == Sign::Positive)),
        }
    }

    /// The projection along an axis, mirrored if a triangle does not turn left.
    fn turning(axis: u8, left: bool) -> Projection {
        let (x, y) = ((axis + 1) % 3, (axis + 2) % 3);
        if left {
            Projection { x, y }
        } else {
            Projection { x: y, y: x }
        }
    }

    /// A point in the projection.
    #[inline(always)]
    pub(super) fn flat(&self, p: &[f64; 3]) -> [f64; 2] {
        [p[usize::from(self.x)], p[usize::from(self.y)]]
    }

    /// Positive when `a`, `b`, `c` turn left in the projection.
    #[inline]
    pub(super) fn turn(&self, a: &[f64; 3], b: &[f64; 3], c: &[f64; 3]) -> Sign {
        orient2d(self.flat(a), self.flat(b), self.flat(c))
    }

    /// The end of `p q` (0 or 1) beyond which a point `r`, collinear in the projection, strictly lies; `None` if it lies beyond neither.
    #[inline]
    pub(super) fn beyond(&self, p: &[f64; 3], q: &[f64; 3], r: &[f64; 3]) -> Option<usize> {
        // Along the line, a coordinate that differs between p and q is strictly monotone.
        let axis = [self.x, self.y].map(usize::from).into_iter().find(|&axis| p[axis] != q[axis])?;
        let (p, q, r) = (p[axis], q[axis], r[axis]);
        if r > p.max(q) {
            Some(usize::from(q > p))
        } else if r < p.min(q) {
            Some(usize::from(q < p))
        } else {
            None
        }
    }
}

/// Where a point of the plane lies relative to a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Location {
    /// Not on the closed triangle.
    Outside,
    /// On a corner.
    Corner,
    /// Strictly inside edge `k`.
    Edge(usize),
    /// Strictly inside.
    Inside,
}

impl Location {
    /// The location, from the sides of the three edges (positive is inward).
    pub(super) fn from_sides(sides: [Sign; 3]) -> Location {
        if sides.contains(&Sign::Negative) {
            return Location::Outside;
        }
        let on = |k: &usize| sides[*k] == Sign::Zero;
        match ((0..3).filter(on).count(), (0..3).find(on)) {
            (0, _) => Location::Inside,
            (1, Some(k)) => Location::Edge(k),
            _ => Location::Corner,
        }
    }
}

/// Locates a point that lies in the triangle's plane.
pub(super) fn locate_in_plane(triangle: &Triangle, projection: &Projection, p: &[f64; 3]) -> Location {
    Location::from_sides(std::array::from_fn(|k| {
        let [a, b] = triangle.edge_points(k);
        projection.turn(a, b, p)
    }))
}

/// Whether `p` lies strictly between `a` and `b` on their segment.
pub(super) fn strictly_between(p: &[f64; 3], a: &[f64; 3], b: &[f64; 3]) -> bool {
    if p == a || p == b || (0..3).any(|k| (p[k] < a[k] && p[k] < b[k]) || (p[k] > a[k] && p[k] > b[k])) {
        return false;
    }
    collinear(p, a, b)
}

/// Whether three points lie on a line: exactly when all three projections do.
pub(super) fn collinear(a: &[f64; 3], b: &[f64; 3], c: &[f64; 3]) -> bool {
    [(0, 1), (1, 2), (2, 0)].into_iter().all(|(x, y)| Projection { x, y }.turn(a, b, c) == Sign::Zero)
}
