//! Shortcut for the facets of most models: one ring of three corners, or of four that are convex in projection.
use crate::plc::polygon::metric::is_inside_circle;
use crate::plc::polygon::{collinear, project};
use crate::predicates::{incircle, orient2d, Sign};
use crate::vector::sub;

/// The triangles of a simple small ring; `None` if the general algorithm must decide.
pub fn triangulate_small(points: &[[f64; 3]], ring: &[u32]) -> Option<([[u32; 3]; 2], usize)> {
    match *ring {
        [a, b, c] if !collinear(points, a, b, c) => Some(([[a, b, c]; 2], 1)),
        [a, b, c, d] => Some((quad(points, [a, b, c, d])?, 2)),
        _ => None,
    }
}

/// Splits a quadrilateral that is strictly convex in its largest axis projection by its Delaunay diagonal in space, or in projection if it
/// has a circumcircle. `None` for others.
fn quad(points: &[[f64; 3]], ring: [u32; 4]) -> Option<[[u32; 3]; 2]> {
    let [p, q, r, s] = ring.map(|v| &points[v as usize]);
    let (d, e) = (sub(r, p), sub(s, q));
    let size = |axis: usize| {
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
        (d[i] * e[j] - d[j] * e[i]).abs()
    };
    let axis = [1, 0].into_iter().fold(2, |best, axis| if size(axis) > size(best) { axis } else { best });
    let at = ring.map(|v| project(&points[v as usize], axis));
    let sense = orient2d(at[0], at[1], at[2]);
    let convex = (1..4).all(|i| orient2d(at[i], at[(i + 1) % 4], at[(i + 2) % 4]) == sense);
    if sense == Sign::Zero || !convex {
        return None;
    }
    let [a, b, c, d] = ring;
    let turned = if sense == Sign::Positive { [p, q, r, s] } else { [r, q, p, s] };
    let holds = |corners| is_inside_circle(axis, p, corners);
    let [k, l, m, n] = turned;
    let flip = match (holds([k, l, m, n]), holds([l, m, n, k])) {
        (false, false) => {
            let inside = incircle(at[0], at[1], at[2], at[3]);
            inside != Sign::Zero && inside == sense
        }
        (flip, _) => flip,
    };
    Some(if flip { [[a, b, d], [b, c, d]] } else { [[a, b, c], [a, c, d]] })
}
