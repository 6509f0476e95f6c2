//! A triangle with its corners at hand, its projection along an axis, and the place of a point of its plane in it.
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
}

impl Triangle {
    #[inline]
    pub(super) fn new(points: &[[f64; 3]], index: u32, facet: u32, ids: [u32; 3]) -> Triangle {
        Triangle { index, facet, ids, corners: ids.map(|v| points[v as usize]) }
    }

    /// On which side of the plane a point lies.
    #[inline]
    pub(super) fn side(&self, p: &[f64; 3]) -> Sign {
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

/// A projection along an axis in which a triangle keeps an area and turns left.
#[derive(Clone, Copy, Debug)]
pub(super) struct Projection {
    x: usize,
    y: usize,
}

impl Projection {
    /// The projection for a triangle; none if it is degenerate.
    pub(super) fn of(corners: &[[f64; 3]; 3]) -> Option<Projection> {
        let [a, b, c] = corners;
        [(0, 1), (1, 2), (2, 0)].into_iter().find_map(|(x, y)| {
            let projection = Projection { x, y };
            match projection.turn(a, b, c) {
                Sign::Positive => Some(projection),
                Sign::Negative => Some(Projection { x: y, y: x }),
                Sign::Zero => None,
            }
        })
    }

    /// Positive when `a`, `b`, `c` turn left in the projection.
    #[inline]
    pub(super) fn turn(&self, a: &[f64; 3], b: &[f64; 3], c: &[f64; 3]) -> Sign {
        let flat = |p: &[f64; 3]| [p[self.x], p[self.y]];
        orient2d(flat(a), flat(b), flat(c))
    }
}

/// Where a point of the plane lies with respect to a triangle.
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
    /// From the sides of the three edges (positive is inward).
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
