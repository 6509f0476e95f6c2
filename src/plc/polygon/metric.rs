//! Circles in the plane of a facet, not in its projection, decide which diagonals a polygon gets.
//!
//! A projection stretches an inclined plane, so a triangulation that is Delaunay in it is not Delaunay in space. With squared distances in
//! space as lifts (the plane need not be known) Lawson's flips (1977) lead to the Delaunay triangulation of the polygon itself, whose edges
//! the Delaunay tetrahedralization of all points is likely to have. Rounded arithmetic suffices: any triangulation of a polygon is valid.
//! Whether a quadrilateral is convex is decided exactly, in the projection.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::plc::polygon::delaunay::{next, prev, Triangulation};
use crate::plc::polygon::project;
use crate::predicates::Sign;
use crate::INVALID;

/// Relative to the size of its terms, a determinant below this counts as zero. Three orders of magnitude above the rounding of the terms,
/// so that points meant to lie on a circle do.
const TIE: f64 = 1e-13;

/// Whether the last point lies inside the circle through the others, counter-clockwise along `axis`, by more than rounding. Lifts
/// are squared distances from `origin`: with one origin for all edges of a polygon, every flip lowers the lifted surface, so
/// flips end.
pub fn is_inside_circle(axis: usize, origin: &[f64; 3], [a, b, c, d]: [&[f64; 3]; 4]) -> bool {
    let lift = |p: &[f64; 3]| (0..3).map(|k| (p[k] - origin[k]) * (p[k] - origin[k])).sum::<f64>();
    let (e, low) = (project(d, axis), lift(d));
    let row = |p: &[f64; 3]| {
        let (q, high) = (project(p, axis), lift(p));
        (q[0] - e[0], q[1] - e[1], high - low, high + low)
    };
    let [a, b, c] = [a, b, c].map(row);
    let mut sum = 0.0;
    let mut size = 0.0;
    for (p, q, r) in [(a, b, c), (b, c, a), (c, a, b)] {
        sum += p.2 * (q.0 * r.1 - q.1 * r.0);
        size += p.3 * ((q.0 * r.1).abs() + (q.1 * r.0).abs());
    }
    sum > TIE * size
}

/// Flips edges between inner triangles that no polygon uses. `points` has the position in space of each vertex.
pub(super) fn improve(
    mesh: &mut Triangulation,
    inside: &[bool],
    axis: usize,
    points: impl Fn(u32) -> [f64; 3],
    stack: &mut Vec<u32>,
    control: &Control,
) -> Result<(), Error> {
    stack.clear();
    fallible::extend(stack, (0..mesh.corner.len() as u32).filter(|&h| h < mesh.twin[h as usize]))?;
    let origin = points(0);
    while let Some(h) = stack.pop() {
        control.step()?;
        let g = mesh.twin[h as usize];
        if mesh.mark[h as usize] != INVALID || !inside[h as usize / 3] || !inside[g as usize / 3] {
            continue;
        }
        let [c, a, b, d] = [mesh.corner[h as usize], mesh.from(h), mesh.to(h), mesh.corner[g as usize]];
        let at = [c, a, b, d].map(&points);
        let convex = || mesh.turn(c, a, d) == Sign::Positive && mesh.turn(d, b, c) == Sign::Positive;
        if !is_inside_circle(axis, &origin, at.each_ref()) || !convex() {
            continue;
        }
        // A flip clears the marks of both triangles; the twins of their half-edges still have them.
        let [t, u] = mesh.flip(h).map(|side| side / 3);
        for side in (3 * t..3 * t + 3).chain(3 * u..3 * u + 3) {
            mesh.mark[side as usize] = mesh.mark[mesh.twin[side as usize] as usize];
        }
        fallible::extend(stack, [3 * t, 3 * u].into_iter().chain([prev(3 * t), next(3 * u)]))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::Triangulator;
    use crate::control::Control;
    use crate::plc::Interior;

    /// Points of the plane x = 3 y + 0.1 z, where neither projection along x nor along y keeps circles.
    fn leaning(points: &[[f64; 2]]) -> Vec<[f64; 3]> {
        points.iter().map(|&[y, z]| [3.0 * y + 0.1 * z, y, z]).collect()
    }

    /// Whether the circle through three corners holds another point, in space.
    fn holds(points: &[[f64; 3]], [a, b, c]: [u32; 3], d: u32) -> bool {
        let at = |v: u32| points[v as usize];
        let minus = |p: [f64; 3], q: [f64; 3]| [0, 1, 2].map(|k| p[k] - q[k]);
        let dot = |p: [f64; 3], q: [f64; 3]| p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
        let (u, v) = (minus(at(b), at(a)), minus(at(c), at(a)));
        let (uu, uv, vv) = (dot(u, u), dot(u, v), dot(v, v));
        let det = 2.0 * (uu * vv - uv * uv);
        let (s, t) = ((uu * vv - vv * uv) / det, (vv * uu - uu * uv) / det);
        let center = [0, 1, 2].map(|k| at(a)[k] + s * u[k] + t * v[k]);
        let square = |p: [f64; 3]| dot(minus(p, center), minus(p, center));
        square(at(d)) < square(at(a)) * (1.0 - 1e-9)
    }

    fn triangulate(points: &[[f64; 3]]) -> Vec<[u32; 3]> {
        let ring: Vec<u32> = (0..points.len() as u32).collect();
        let mut triangulator = Triangulator::new(points.len()).unwrap();
        if !triangulator.triangulate_ring(points, &ring).unwrap() {
            let polygon = triangulator.add_polygon(super::super::Role::Outer).unwrap();
            for k in 0..ring.len() {
                triangulator.add_edge(polygon, ring[k], ring[(k + 1) % ring.len()]).unwrap();
            }
            let control = Control::free();
            triangulator.triangulate(points, Interior::default(), &[], &control).unwrap().unwrap();
        }
        triangulator.triangles
    }

    #[test]
    fn polygons_that_lean_are_delaunay_in_space() {
        let heptagon = [[0.0, 0.0], [2.0, -0.3], [3.1, 0.9], [3.0, 2.2], [1.7, 3.1], [0.2, 2.4], [-0.8, 1.1]];
        let quadrilateral = [[0.0, 0.0], [0.4, -1.0], [1.3, 0.1], [0.5, 1.2]];
        for corners in [&heptagon[..], &quadrilateral] {
            for turn in 0..corners.len() {
                let mut corners = corners.to_vec();
                corners.rotate_left(turn);
                for reverse in [false, true] {
                    if reverse {
                        corners.reverse();
                    }
                    let points = leaning(&corners);
                    let triangles = triangulate(&points);
                    assert_eq!(triangles.len(), corners.len() - 2);
                    for &t in &triangles {
                        let others = (0..corners.len() as u32).filter(|v| !t.contains(v));
                        assert_eq!(others.filter(|&d| holds(&points, t, d)).count(), 0, "{triangles:?}");
                    }
                }
            }
        }
    }
}
