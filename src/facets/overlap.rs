//! An exact test whether a triangle meets the interior of a tetrahedron, for every kind of contact.
//!
//! Two convex sets, one of them solid, have disjoint interiors exactly if one of finitely many planes separates them weakly:
//! those of the faces, and those spanned by an edge of each (the facets of the Minkowski difference). Contacts in
//! vertices, edges and faces are no overlap.
use crate::kernel::tables::{EDGE, FACE};
use crate::predicates::{Expansion, Points, Sign};
use crate::vector;

/// Whether the open tetrahedron (positive) and the closed triangle have a common point.
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

/// Whether a plane along an edge of each separates the two.
fn separated_by_edges(points: &Points, tet: [u32; 4], triangle: [u32; 3]) -> bool {
    let rounded = Rounded::new(points, tet, triangle);
    let mut exact: Option<([Vector; 4], [Vector; 3])> = None;
    for e in 0..6 {
        let (i, j) = (EDGE[e][0] as usize, EDGE[e][1] as usize);
        let (k, l) = (EDGE[5 - e][0] as usize, EDGE[5 - e][1] as usize);
        for m in 0..3 {
            let (r, s, u) = (m, (m + 1) % 3, (m + 2) % 3);
            if let Some(separated) = rounded.separated([i, j, k, l], [r, s, u]) {
                if separated {
                    return true;
                }
                continue;
            }
            let (t, g) = exact.get_or_insert_with(|| {
                (tet.map(|v| points.exact_coordinates(v)), triangle.map(|v| points.exact_coordinates(v)))
            });
            let normal = cross(&subtract(&t[j], &t[i]), &subtract(&g[s], &g[r]));
            if normal.iter().all(|x| x.sign() == Sign::Zero) {
                continue;
            }
            let side = |x: &Vector| dot(&normal, &subtract(x, &t[i])).sign();
            if apart([side(&t[k]), side(&t[l])], [side(&g[r]), side(&g[u])]) {
                return true;
            }
        }
    }
    false
}

/// Whether the two are weakly on different sides.
fn apart(of_tet: [Sign; 2], of_triangle: [Sign; 2]) -> bool {
    [Sign::Positive, Sign::Negative]
        .into_iter()
        .any(|one| of_tet.iter().all(|&x| x != -one) && of_triangle.iter().all(|&x| x != one))
}

/// Nearest doubles of the corners, relative to the first one.
struct Rounded {
    ids: [u32; 7],
    corners: [[f64; 3]; 7],
    /// Bound on the error of a determinant of three differences of corners. Values within it are left to exact signs.
    ///
    /// With differences up to M, off by up to e, each of six monomials is off by at most 3 e (M + e)², and 8 roundings contribute to the
    /// value (as counted in `predicates::filter`): 18 e (M + e)² + 6 · 9 u (M + e)³.
    bound: f64,
}

impl Rounded {
    fn new(points: &Points, tet: [u32; 4], triangle: [u32; 3]) -> Rounded {
        let ids = [tet[0], tet[1], tet[2], tet[3], triangle[0], triangle[1], triangle[2]];
        let corners = ids.map(|v| *points.xyz(v));
        let largest = corners.iter().flatten().fold(0.0f64, |m, x| m.max(x.abs()));
        let widest = (0..3).fold(0.0f64, |widest, k| {
            let (low, high) = corners
                .iter()
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), p| (low.min(p[k]), high.max(p[k])));
            widest.max(high - low)
        });
        // With nearest doubles, two corners are off by half a unit each.
        let error = if ids.iter().all(|&v| points.is_explicit(v)) { 0.0 } else { largest * f64::EPSILON };
        let size = widest + error;
        let bound = (18.0 * error + 28.0 * f64::EPSILON * size) * size * size + f64::MIN_POSITIVE;
        Rounded { ids, corners, bound }
    }

    /// Whether the plane along edge `i j` of the tetrahedron and `r s` of the triangle separates them; `None` if rounding does not tell.
    fn separated(&self, [i, j, k, l]: [usize; 4], [r, s, u]: [usize; 3]) -> Option<bool> {
        let [r, s, u] = [r, s, u].map(|x| x + 4);
        let from = |x: usize, y: usize| vector::sub(&self.corners[y], &self.corners[x]);
        let normal = vector::cross(&from(i, j), &from(r, s));
        let side = |x: usize| -> Option<Sign> {
            if [i, j].iter().any(|&y| self.ids[x] == self.ids[y]) {
                return Some(Sign::Zero);
            }
            let value = vector::dot(&normal, &from(i, x));
            (value.abs() > self.bound).then(|| Sign::of(value))
        };
        // Both ends of `r s` are equally far from the plane.
        let along = if self.ids[s] == self.ids[i] || self.ids[s] == self.ids[j] { side(s) } else { side(r) };
        let same = |x: usize| self.ids[x] == self.ids[r] || self.ids[x] == self.ids[s];
        let of_tet = [k, l].map(|x| if same(x) { along } else { side(x) });
        let of_triangle = [along, side(u)];
        let mut known = [[false; 2]; 2];
        for (known, signs) in known.iter_mut().zip([of_tet, of_triangle]) {
            for sign in signs.into_iter().flatten() {
                known[0] |= sign == Sign::Positive;
                known[1] |= sign == Sign::Negative;
            }
        }
        let [tet, triangle] = known;
        let both_sides = |of: [bool; 2]| of == [true; 2];
        let same_side = (0..2).any(|k| tet[k] && triangle[k]);
        if both_sides(tet) || both_sides(triangle) || same_side {
            return Some(false);
        }
        let all = |signs: [Option<Sign>; 2]| Some([signs[0]?, signs[1]?]);
        let (of_tet, of_triangle) = (all(of_tet)?, all(of_triangle)?);
        let flat = of_tet.iter().chain(&of_triangle).all(|&x| x == Sign::Zero);
        // If all are zero, the edges may be parallel, and then there is no plane.
        (!flat).then(|| apart(of_tet, of_triangle))
    }
}

type Vector = [Expansion; 3];

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
