//! Does a triangle meet the interior of a tetrahedron? Exactly, with all contacts.
//!
//! Two convex sets, one of them solid, have disjoint interiors exactly if one of finitely many planes separates them weakly:
//! those of the faces, and those spanned by an edge of each (the facets of the Minkowski difference). Contacts in
//! vertices, edges and faces are no overlap.
use crate::mesh::tables::{EDGE, FACE};
use crate::predicates::{Expansion, Points, Sign};

/// The open tetrahedron (positive) and the closed triangle have a common point.
pub fn overlaps(points: &Points, tet: [u32; 4], triangle: [u32; 3]) -> bool {
    for face in FACE {
        let [x, y, z] = face.map(|k| tet[k as usize]);
        if triangle.iter().all(|&v| [x, y, z].contains(&v) || points.orient3d(v, x, y, z) != Sign::Positive) {
            return false;
        }
    }
    let [r, s, u] = triangle;
    let sides = tet.map(|v| if triangle.contains(&v) { Sign::Zero } else { points.orient3d(r, s, u, v) });
    if !sides.contains(&Sign::Positive) || !sides.contains(&Sign::Negative) {
        return false;
    }
    !separated_by_edges(points, tet, triangle)
}

type Vector = [Expansion; 3];

/// A plane along an edge of each separates the two.
fn separated_by_edges(points: &Points, tet: [u32; 4], triangle: [u32; 3]) -> bool {
    let t: [Vector; 4] = tet.map(|v| points.exact_coordinates(v));
    let g: [Vector; 3] = triangle.map(|v| points.exact_coordinates(v));
    for e in 0..6 {
        let (i, j) = (EDGE[e][0] as usize, EDGE[e][1] as usize);
        let (k, l) = (EDGE[5 - e][0] as usize, EDGE[5 - e][1] as usize);
        let along = subtract(&t[j], &t[i]);
        for m in 0..3 {
            let (r, s, u) = (m, (m + 1) % 3, (m + 2) % 3);
            let normal = cross(&along, &subtract(&g[s], &g[r]));
            if normal.iter().all(|x| x.sign() == Sign::Zero) {
                continue;
            }
            let side = |x: &Vector| dot(&normal, &subtract(x, &t[i])).sign();
            let of_tet = [side(&t[k]), side(&t[l])];
            let of_triangle = [side(&g[r]), side(&g[u])];
            let apart = |one: Sign| {
                of_tet.iter().all(|&x| x == one || x == Sign::Zero)
                    && of_triangle.iter().all(|&x| x == -one || x == Sign::Zero)
            };
            if apart(Sign::Positive) || apart(Sign::Negative) {
                return true;
            }
        }
    }
    false
}

fn subtract(a: &Vector, b: &Vector) -> Vector {
    std::array::from_fn(|k| a[k].difference(&b[k]))
}

fn cross(a: &Vector, b: &Vector) -> Vector {
    std::array::from_fn(|k| {
        let (u, v) = ((k + 1) % 3, (k + 2) % 3);
        a[u].product(&b[v]).difference(&a[v].product(&b[u]))
    })
}

fn dot(a: &Vector, b: &Vector) -> Expansion {
    a[0].product(&b[0]).sum(&a[1].product(&b[1])).sum(&a[2].product(&b[2]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(triangle: [[f64; 3]; 3], expected: bool) {
        let mut all = vec![[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 4.0]];
        all.extend(triangle);
        let points = Points::new(all);
        assert_eq!(overlaps(&points, [0, 1, 2, 3], [4, 5, 6]), expected, "{triangle:?}");
    }

    #[test]
    fn contacts_are_no_overlap() {
        // In the plane of a face; touching an edge from outside; touching a vertex; an edge lying on an edge.
        check([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]], false);
        check([[1.0, 1.0, 0.0], [2.0, 0.5, 0.0], [9.0, 9.0, 0.0]], false);
        check([[2.0, -1.0, -1.0], [2.0, 1.0, -1.0], [2.0, -1.0, 1.0]], false);
        check([[1.0, 0.0, 0.0], [3.0, 0.0, 0.0], [2.0, -3.0, -3.0]], false);
        check([[0.0, 0.0, 4.0], [1.0, 0.0, 9.0], [0.0, 1.0, 9.0]], false);
        check([[9.0, 9.0, 9.0], [10.0, 9.0, 9.0], [9.0, 10.0, 9.0]], false);
    }

    #[test]
    fn interiors_are_found() {
        // Through the middle without a vertex inside, along a face's interior, a vertex inside.
        check([[-9.0, -9.0, 1.0], [9.0, -9.0, 1.0], [0.0, 20.0, 1.0]], true);
        check([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 3.0, 3.0]], true);
        check([[0.5, 0.5, 0.5], [9.0, 9.0, 9.0], [9.0, 9.0, 0.0]], true);
        // Only an edge of the triangle passes through two faces near an edge of the tetrahedron.
        check([[-1.0, 2.0, 1.0], [3.0, -2.0, 1.0], [-9.0, -9.0, -9.0]], true);
    }
}
