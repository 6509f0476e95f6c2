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
    /// The smallest sine of a dihedral angle: of the smallest angle, or of the largest if that is nearer to 180°.
    pub dihedral: f64,
    /// The volume.
    pub volume: f64,
}

/// One of the two measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// The smallest dihedral angle.
    Angle,
    /// The radius-edge ratio.
    Ratio,
    /// The dihedral angle nearest to 0° or 180°.
    Dihedral,
}

impl Shape {
    /// Better than any tetrahedron.
    pub const BEST: Shape =
        Shape { angle: f64::INFINITY, ratio: f64::INFINITY, dihedral: f64::INFINITY, volume: 0.0 };

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
            return Shape::default();
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
        let (mut sine, mut blunt) = (f64::INFINITY, f64::INFINITY);
        for (i, j, e) in MEET {
            let product = squares[i] * squares[j];
            if product < TINY {
                continue;
            }
            let least = if dot(&normals[i], &normals[j]) < 0.0 { &mut sine } else { &mut blunt };
            *least = least.min(edges[e] / product);
        }
        let of = |square: f64| if square.is_finite() { det * square.sqrt() } else { 0.0 };
        let center_along = |k: usize| uu * n1[k] + vv * n2[k] + ww * n3[k];
        let center = [center_along(0), center_along(1), center_along(2)];
        let shortest = edges.into_iter().fold(f64::INFINITY, f64::min);
        Shape {
            angle: of(sine),
            ratio: 2.0 * det * (shortest / dot(&center, &center).max(TINY)).sqrt(),
            dihedral: of(sine.min(blunt)),
            volume: det * size * size * size / 6.0,
        }
    }

    /// The worse of both in each measure.
    pub fn worse(self, other: Shape) -> Shape {
        Shape {
            angle: self.angle.min(other.angle),
            ratio: self.ratio.min(other.ratio),
            dihedral: self.dihedral.min(other.dihedral),
            volume: self.volume.max(other.volume),
        }
    }

    /// One of the measures.
    pub fn by(self, measure: Measure) -> f64 {
        match measure {
            Measure::Angle => self.angle,
            Measure::Ratio => self.ratio,
            Measure::Dihedral => self.dihedral,
        }
    }
}

/// [`Shape::dihedral`] alone, and quicker: for searches that compare many positions.
#[inline]
pub fn sine([o, p, q, r]: [&[f64; 3]; 4]) -> f64 {
    let [u, v, w] = [sub(p, o), sub(q, o), sub(r, o)];
    let size = [u, v, w].iter().flatten().fold(f64::MIN_POSITIVE, |m, x| m.max(x.abs()));
    // All numbers are near one, so none that counts over- or underflows.
    let unit = 1.0 / size;
    let scaled = |x: [f64; 3]| [x[0] * unit, x[1] * unit, x[2] * unit];
    let [u, v, w] = [scaled(u), scaled(v), scaled(w)];
    let [vu, wu, wv] = [sub(&v, &u), sub(&w, &u), sub(&w, &v)];
    let normals = [cross(&wu, &vu), cross(&v, &w), cross(&w, &u), cross(&u, &v)];
    let det = dot(&u, &normals[1]);
    if det.is_nan() || det <= 0.0 {
        return 0.0;
    }
    let [a, b, c, d] = &normals;
    let [aa, bb, cc, dd] = [dot(a, a), dot(b, b), dot(c, c), dot(d, d)];
    let pairs = [
        (aa * bb, dot(&wv, &wv)),
        (aa * cc, dot(&wu, &wu)),
        (aa * dd, dot(&vu, &vu)),
        (bb * cc, dot(&w, &w)),
        (bb * dd, dot(&v, &v)),
        (cc * dd, dot(&u, &u)),
    ];
    // The least quotient, by products instead of divisions.
    let [mut least, rest @ ..] = pairs;
    for (product, edge) in rest {
        if edge * least.0 < least.1 * product {
            least = (product, edge);
        }
    }
    let square = least.1 / least.0;
    if square.is_finite() {
        det * square.sqrt()
    } else {
        0.0
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
    /// The largest volume that may come.
    pub largest: f64,
}

impl Goal {
    /// The quality of a tetrahedron; −1 if it misses the other measure's bound or is too large.
    pub fn quality(&self, shape: Shape) -> f64 {
        let (quality, other) = match self.measure {
            Measure::Angle => (shape.angle, shape.ratio),
            Measure::Ratio => (shape.ratio, shape.angle),
            Measure::Dihedral => (shape.dihedral, shape.ratio),
        };
        if other < self.least || shape.volume > self.largest {
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
    fn the_quick_angle_is_the_angle() {
        let mut state = 7u64;
        let mut random = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 40) as f64 / 16777216.0
        };
        for _ in 0..1000 {
            let p: [[f64; 3]; 4] = std::array::from_fn(|_| std::array::from_fn(|_| random()));
            let [a, b, c, d] = &p;
            let slow = Shape::at([a, b, c, d]).dihedral;
            for exponent in [0, -190, -110, 110, 195] {
                let unit = crate::elementary::power_of_two(exponent);
                let far = p.map(|x| x.map(|x| x * unit));
                let [a, b, c, d] = &far;
                let quick = sine([a, b, c, d]);
                assert!((slow - quick).abs() <= 1e-9, "{slow} {quick} {exponent}");
            }
        }
    }

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
            assert_eq!(Shape { volume: shape.volume, ..Shape::at([&a, &b, &d, &c]) }, shape);
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
