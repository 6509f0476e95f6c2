//! The shape of a tetrahedron by the two measures that matter for refinement, in floating-point arithmetic: it orders work and chooses
//! among valid fillings, but never decides validity.
//!
//! One is the smallest of the six dihedral angles, by its sine: `sin = 6 V l / (4 A B)` at an edge of length `l` between faces of areas `A`
//! and `B`. A flat tetrahedron always has a small one. The other is the ratio of the shortest edge to the circumradius, which bounds the
//! result of a Delaunay refinement of the mesh (Miller et al. 1995; Shewchuk 1998).
use crate::predicates::Points;
use crate::vector::{cross, dot, sub};

/// The two measures; larger is better.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shape {
    /// Sine of the smallest dihedral angle.
    pub angle: f64,
    /// Shortest edge over circumradius.
    pub ratio: f64,
}

/// One of the two measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// The smallest dihedral angle.
    Angle,
    /// The radius-edge ratio.
    Ratio,
}

impl Shape {
    /// Better than any tetrahedron.
    pub const BEST: Shape = Shape { angle: f64::INFINITY, ratio: f64::INFINITY };

    /// The shape of a positive tetrahedron, independent of the order of its vertices: hill climbing relies on equal tetrahedra having equal
    /// shapes.
    pub fn of(points: &Points, mut v: [u32; 4]) -> Shape {
        let mut odd = false;
        for (i, j) in [(0, 1), (2, 3), (0, 2), (1, 3), (1, 2)] {
            if v[i] > v[j] {
                v.swap(i, j);
                odd = !odd;
            }
        }
        if odd {
            v.swap(2, 3);
        }
        Shape::at(v.map(|i| points.xyz(i)))
    }

    /// The shape of a positive tetrahedron; zero if floating-point arithmetic does not find it positive.
    pub fn at([o, p, q, r]: [&[f64; 3]; 4]) -> Shape {
        // Written out, since closures over arrays of arrays would become calls, and this runs for every tetrahedron of a mesh.
        let [u, v, w] = [sub(p, o), sub(q, o), sub(r, o)];
        let size = [u, v, w].iter().flatten().fold(f64::MIN_POSITIVE, |m, x| m.max(x.abs()));
        // All numbers are near one, so no relevant value over- or underflows.
        let scaled = |x: [f64; 3]| [x[0] / size, x[1] / size, x[2] / size];
        let [u, v, w] = [scaled(u), scaled(v), scaled(w)];
        let [vu, wu, wv] = [sub(&v, &u), sub(&w, &u), sub(&w, &v)];
        let normals = [cross(&wu, &vu), cross(&v, &w), cross(&w, &u), cross(&u, &v)];
        let det = dot(&u, &normals[1]);
        if det <= 0.0 {
            return Shape { angle: 0.0, ratio: 0.0 };
        }
        let square = |e: &[f64; 3]| dot(e, e);
        let [n0, n1, n2, n3] = &normals;
        let squares = [square(n0), square(n1), square(n2), square(n3)];
        let [uu, vv, ww] = [square(&u), square(&v), square(&w)];
        let edges = [uu, vv, ww, square(&vu), square(&wu), square(&wv)];
        // Faces i and j (opposite corners i and j) meet at the edge of the two others.
        const MEET: [(usize, usize, usize); 6] =
            [(0, 1, 5), (0, 2, 4), (0, 3, 3), (1, 2, 2), (1, 3, 1), (2, 3, 0)];
        /// Nothing here is larger than 12: divided by this or more it does not overflow.
        const TINY: f64 = 16.0 * f64::MIN_POSITIVE;
        let mut sine = f64::INFINITY;
        for (i, j, e) in MEET {
            let product = squares[i] * squares[j];
            if dot(&normals[i], &normals[j]) < 0.0 && product >= TINY {
                sine = sine.min(edges[e] / product);
            }
        }
        let center_along = |k: usize| uu * n1[k] + vv * n2[k] + ww * n3[k];
        let center = [center_along(0), center_along(1), center_along(2)];
        let shortest = edges.into_iter().fold(f64::INFINITY, f64::min);
        Shape {
            angle: if sine.is_finite() { det * sine.sqrt() } else { 0.0 },
            ratio: 2.0 * det * (shortest / dot(&center, &center).max(TINY)).sqrt(),
        }
    }

    /// The worse of both in each measure.
    pub fn worse(self, other: Shape) -> Shape {
        Shape { angle: self.angle.min(other.angle), ratio: self.ratio.min(other.ratio) }
    }

    /// One of the measures.
    pub fn by(self, measure: Measure) -> f64 {
        match measure {
            Measure::Angle => self.angle,
            Measure::Ratio => self.ratio,
        }
    }
}

/// The shortest edge of a triangle over its circumradius: no tetrahedron on it has a larger ratio.
pub fn needle([p, q, r]: [&[f64; 3]; 3]) -> f64 {
    let [u, v, w] = [sub(q, p), sub(r, p), sub(r, q)];
    let [a, b, c] = [u, v, w].map(|e| dot(&e, &e).sqrt());
    let n = cross(&u, &v);
    // The circumradius is a b c / (2 |u × v|).
    a.min(b).min(c) * 2.0 * dot(&n, &n).sqrt() / (a * b * c)
}

/// What a filling must reach: all its tetrahedra are better than `above` in one measure and no worse than `least` in the other.
#[derive(Clone, Copy, Debug)]
pub struct Goal {
    /// The measure to be improved.
    pub measure: Measure,
    /// The value that must be exceeded.
    pub above: f64,
    /// The value that the other measure must reach.
    pub least: f64,
}

impl Goal {
    /// The quality of a tetrahedron; −1 if it misses the other measure's bound.
    pub fn quality(&self, shape: Shape) -> f64 {
        let (quality, other) = match self.measure {
            Measure::Angle => (shape.angle, shape.ratio),
            Measure::Ratio => (shape.ratio, shape.angle),
        };
        if other < self.least {
            -1.0
        } else {
            quality
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_tetrahedra_have_known_shapes() {
        let regular = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
        let [a, b, c, d] = &regular;
        let shape = Shape::at([a, b, d, c]);
        let expected = [(8.0f64 / 9.0).sqrt(), (8.0f64 / 3.0).sqrt()];
        assert!((shape.angle - expected[0]).abs() < 1e-14 && (shape.ratio - expected[1]).abs() < 1e-14);
        assert_eq!(Shape::at([a, b, c, d]).angle, 0.0, "it is negative");
        // Scaling to the ends of the range changes next to nothing.
        for size in [2f64.powi(195), 2f64.powi(-200)] {
            let [a, b, c, d] = regular.map(|p| p.map(|x| x * size));
            assert_eq!(Shape::at([&a, &b, &d, &c]), shape);
        }
        // A corner of a cube: angles of 90° and arccos(1/√3); circumradius √3/2.
        let shape = Shape::at([&[0.0; 3], &[1.0, 0.0, 0.0], &[0.0, 1.0, 0.0], &[0.0, 0.0, 1.0]]);
        assert!((shape.angle - (2.0f64 / 3.0).sqrt()).abs() < 1e-14);
        assert!((shape.ratio - 2.0 / 3f64.sqrt()).abs() < 1e-14);
        // Four points near a plane: obtuse angles do not count, the small ones do.
        let h = 1e-9;
        let shape = Shape::at([&[1.0, 0.0, h], &[0.0, 1.0, 0.0], &[-1.0, 0.0, h], &[0.0, -1.0, 0.0]]);
        let flipped = Shape::at([&[1.0, 0.0, h], &[-1.0, 0.0, h], &[0.0, 1.0, 0.0], &[0.0, -1.0, 0.0]]);
        let found = shape.angle.max(flipped.angle);
        assert!(found > h && found < 4.0 * h, "{found}");
    }
}
