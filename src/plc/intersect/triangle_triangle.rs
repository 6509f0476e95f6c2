//! Two triangles: legal contact or defect.
//!
//! Most candidate pairs are neighbours. Two triangles with a common edge and different planes meet only in that edge; two with a common
//! vertex are done if the other corners of one lie strictly on one side of the other's plane. The rest is decided on the line where the
//! planes meet: a contact through the interior of both is a defect, one along an edge of both is legal. An edge of one in the interior of
//! the other is treated like a segment there.
use crate::error::{DefectKind, Error};
use crate::plc::intersect::collector::Collector;
use crate::plc::intersect::coplanar;
use crate::plc::intersect::coplanar::{centroid, opposite, record_vertex};
use crate::plc::intersect::locate_point::{locate_in_plane, turn_bound, Location, RoundedPlane, Triangle};
use crate::plc::intersect::segment_triangle::{pierce, piercing_point};
use crate::predicates::Sign;

/// Classifies two triangles.
#[inline]
pub(super) fn classify(a: &Triangle, b: &Triangle, out: &mut Collector) -> Result<(), Error> {
    let shared = match CommonCorners::of(a, b) {
        CommonCorners::None => 0,
        CommonCorners::One(i, j) if cones_apart_by_filter(a, i, b, j) => return Ok(()),
        CommonCorners::One(..) => 1,
        CommonCorners::Two(i, j) if wings_apart_by_filter(a, i, &b.corners[j]) => return Ok(()),
        CommonCorners::Two(..) => 2,
        CommonCorners::All => 3,
    };
    if shared < 3 && (one_side_by_filter(b, a, shared) || one_side_by_filter(a, b, shared)) {
        return Ok(());
    }
    // Ordered, so that the reported point depends only on the pair.
    let (a, b) = if a.index <= b.index { (a, b) } else { (b, a) };
    classify_close(a, b, shared, out)
}

/// Which corners two triangles have in common.
enum CommonCorners {
    None,
    /// The places of the common corner in the two.
    One(usize, usize),
    /// The places of the corners that are not common.
    Two(usize, usize),
    All,
}

impl CommonCorners {
    /// Branch-free up to the last step, since this runs for every candidate pair.
    #[inline(always)]
    fn of(a: &Triangle, b: &Triangle) -> CommonCorners {
        let equal = a.ids.map(|v| b.ids.map(|w| v == w));
        let row = |i: usize| usize::from(equal[i][0] | equal[i][1] | equal[i][2]);
        let column = |j: usize| usize::from(equal[0][j] | equal[1][j] | equal[2][j]);
        let in_a = row(0) | row(1) << 1 | row(2) << 2;
        let in_b = column(0) | column(1) << 1 | column(2) << 2;
        // The position of the only set bit, or of the only clear bit.
        const ONLY: [usize; 8] = [0, 0, 1, 2, 2, 1, 0, 0];
        let (i, j) = (ONLY[in_a], ONLY[in_b]);
        match in_a {
            0 => CommonCorners::None,
            1 | 2 | 4 => CommonCorners::One(i, j),
            7 => CommonCorners::All,
            _ => CommonCorners::Two(i, j),
        }
    }
}

/// Whether rounded arithmetic proves that two triangles with only the corners `i` and `j` in common are disjoint elsewhere: in projection
/// along an axis in which `a` has an area, the line of an edge at that corner has `a` on one side and `b` on the other, one of them
/// strictly. Common points then project to the corner, and only the corner of `a` does.
#[inline(always)]
fn cones_apart_by_filter(a: &Triangle, i: usize, b: &Triangle, j: usize) -> bool {
    let Some(projection) = a.projection else {
        return false;
    };
    let from = projection.flat(&a.corners[i]);
    let arm = |t: &Triangle, k: usize| {
        let p = projection.flat(&t.corners[NEXT[k]]);
        [p[0] - from[0], p[1] - from[1]]
    };
    // `a` turns left from its first arm to its second.
    let [a1, a2, b1, b2] = [arm(a, i), arm(a, i + 1), arm(b, j), arm(b, j + 1)];
    let ([l11, r11], [l12, r12]) = (turn_by_filter(a1, b1), turn_by_filter(a1, b2));
    let ([l21, r21], [l22, r22]) = (turn_by_filter(a2, b1), turn_by_filter(a2, b2));
    let [left, right] = turn_by_filter(b1, b2);
    // Beyond an edge of `a`; beyond one of `b`, whichever way it turns.
    (r11 & r12) | (l21 & l22) | (left & ((l11 & l21) | (r12 & r22))) | (right & ((r11 & r21) | (l12 & l22)))
}

/// The next corner of a triangle, also after the third.
const NEXT: [usize; 4] = [1, 2, 0, 1];

/// Whether rounded arithmetic proves that the second vector points left of the first, and whether it proves that it points right.
#[inline(always)]
fn turn_by_filter(u: [f64; 2], v: [f64; 2]) -> [bool; 2] {
    let (plus, minus) = (u[0] * v[1], u[1] * v[0]);
    let bound = turn_bound(plus.abs() + minus.abs());
    [plus - minus > bound, minus - plus > bound]
}

/// Whether rounded arithmetic proves that `a` and the triangle of `p` and the corners of `a` except corner `i` meet only in that edge: in
/// projection along an axis in which `a` has an area, `p` is beyond the edge.
#[inline(always)]
fn wings_apart_by_filter(a: &Triangle, i: usize, p: &[f64; 3]) -> bool {
    let Some(projection) = a.projection else {
        return false;
    };
    let (q, r) = (projection.flat(&a.corners[NEXT[i]]), projection.flat(&a.corners[NEXT[i + 1]]));
    let p = projection.flat(p);
    let [beyond, _] = turn_by_filter([q[0] - r[0], q[1] - r[1]], [p[0] - r[0], p[1] - r[1]]);
    // `a` turns left from q to r, so it is on the right of the reversed edge.
    beyond
}

/// Whether rounded arithmetic proves that all corners of `t` except the `shared` common ones lie strictly on one side of `of`. (It never
/// claims a side for a common corner.) Counts without branches, since this runs for every candidate pair.
#[inline(always)]
fn one_side_by_filter(t: &Triangle, of: &Triangle, shared: usize) -> bool {
    let (mut above, mut below) = (shared, shared);
    let plane = RoundedPlane::of(&of.corners);
    for p in &t.corners {
        let (det, bound) = plane.side(p);
        above += usize::from(det > bound);
        below += usize::from(det < -bound);
    }
    above == 3 || below == 3
}

/// Classifies two triangles that the filters cannot separate.
#[inline(never)]
fn classify_close(a: &Triangle, b: &Triangle, shared: usize, out: &mut Collector) -> Result<(), Error> {
    if shared == 3 {
        return out.triangles(DefectKind::DuplicateFacet, a, b, centroid(a));
    }
    let a_shared = a.ids.map(|v| b.ids.contains(&v));
    let b_shared = b.ids.map(|v| a.ids.contains(&v));
    if separated_in_projection(a, b, &b_shared) || separated_in_projection(b, a, &a_shared) {
        return Ok(());
    }
    classify_exactly(a, &a_shared, b, &b_shared, out)
}

/// Whether in `a`'s projection the line of one of `a`'s edges has all corners of `b` on its outer side, and those on the line are common
/// corners or lie beyond the edge's ends, all beyond the same end. Then they have nothing else in common, in space either. This saves exact
/// signs in flat patches.
fn separated_in_projection(a: &Triangle, b: &Triangle, b_shared: &[bool; 3]) -> bool {
    let Some(projection) = a.projection else {
        return false;
    };
    (0..3).any(|k| {
        let ([p, q], ends) = (a.edge_points(k), a.edge(k));
        // Common corners are on the edge's line only if they are its ends: this rejects most edges without computing a sign.
        if (0..3).any(|i| b_shared[i] && !ends.contains(&b.ids[i])) {
            return false;
        }
        // Per end of the edge: common with `b`; some corner of `b` on the line beyond it.
        let (common, mut beyond) = (ends.map(|v| b.ids.contains(&v)), [false; 2]);
        let outside = (0..3).filter(|&i| !b_shared[i]).all(|i| {
            let corner = &b.corners[i];
            match projection.turn(p, q, corner) {
                Sign::Negative => true,
                Sign::Positive => false,
                Sign::Zero => projection.beyond(p, q, corner).is_some_and(|end| {
                    beyond[end] = true;
                    true
                }),
            }
        });
        outside && !(beyond[0] && (beyond[1] || common[1])) && !(beyond[1] && common[0])
    })
}

fn classify_exactly(
    a: &Triangle,
    a_shared: &[bool; 3],
    b: &Triangle,
    b_shared: &[bool; 3],
    out: &mut Collector,
) -> Result<(), Error> {
    let shared = b_shared.iter().filter(|&&s| s).count();
    let b_sides = sides(b, b_shared, a);
    if apart(&b_sides, shared) {
        return Ok(());
    }
    if b_sides == [Sign::Zero; 3] {
        return coplanar::classify(a, b, out);
    }
    let a_sides = sides(a, a_shared, b);
    if apart(&a_sides, shared) {
        return Ok(());
    }
    let on_a = vertices_on(a, b, &b_sides, out)?;
    let on_b = vertices_on(b, a, &a_sides, out)?;
    let crossing = crossing(a, &a_sides, b).or_else(|| crossing(b, &b_sides, a));
    // With two corners in the other's plane, the line where the planes meet contains an edge; otherwise it runs through the interior.
    let along_edge = |sides: &[Sign; 3]| sides.iter().filter(|&&s| s == Sign::Zero).count() == 2;
    let along = [along_edge(&a_sides), along_edge(&b_sides)];
    if along == [true; 2] || (crossing.is_none() && shared + on_a.count + on_b.count < 2) {
        return Ok(());
    }
    // All common points lie on an edge of one of them, in the plane of the other.
    match along {
        [true, _] => return out.edge_in_facet(edge_along(a, &a_sides), a),
        [_, true] => return out.edge_in_facet(edge_along(b, &b_sides), b),
        _ => {}
    }
    if let Some(point) = crossing {
        return out.triangles(DefectKind::FacetFacet, a, b, point);
    }
    out.triangles(DefectKind::FacetFacet, a, b, middle_of_contact(a, b, &on_a, &on_b))
}

/// Sides of `t`'s corners from the plane of `of`; common corners are known to lie in it.
#[inline]
fn sides(t: &Triangle, shared: &[bool; 3], of: &Triangle) -> [Sign; 3] {
    std::array::from_fn(|k| if shared[k] { Sign::Zero } else { of.side(&t.corners[k]) })
}

/// Whether only the common corners (at most two) lie in the other's plane, and the rest strictly on one side.
#[inline]
fn apart(sides: &[Sign; 3], shared: usize) -> bool {
    let count = |sign| sides.iter().filter(|&&s| s == sign).count();
    count(Sign::Zero) == shared && (count(Sign::Positive) == 0 || count(Sign::Negative) == 0)
}

/// The edge between the two corners in the other's plane.
fn edge_along(t: &Triangle, sides: &[Sign; 3]) -> [u32; 2] {
    let off = (0..3).find(|&k| sides[k] != Sign::Zero).unwrap_or(0);
    t.edge((off + 1) % 3)
}

/// The point, no vertex, at which an open edge of `a` pierces `b`; `None` if there is none.
fn crossing(a: &Triangle, a_sides: &[Sign; 3], b: &Triangle) -> Option<[f64; 3]> {
    (0..3).find_map(|k| {
        let [p, q] = a.edge_points(k);
        if !opposite(a_sides[k], a_sides[(k + 1) % 3]) {
            return None;
        }
        match pierce(b, p, q, a_sides[k]) {
            Location::Edge(_) | Location::Inside => Some(piercing_point(b, p, q)),
            Location::Outside | Location::Corner => None,
        }
    })
}

/// A point between two of the vertices where the common part of two triangles ends, rounded.
fn middle_of_contact(a: &Triangle, b: &Triangle, on_a: &OnTriangle, on_b: &OnTriangle) -> [f64; 3] {
    let common = a.ids.iter().zip(&a.corners).find(|(v, _)| b.ids.contains(v)).map(|(_, p)| *p);
    let mut ends = [on_a.last, on_b.last, on_a.first, on_b.first, common].into_iter().flatten();
    let first = ends.next().unwrap_or(a.corners[0]);
    let second = ends.find(|p| *p != first).unwrap_or(first);
    std::array::from_fn(|k| 0.5 * first[k] + 0.5 * second[k])
}

/// Vertices of one triangle on another.
struct OnTriangle {
    count: usize,
    first: Option<[f64; 3]>,
    last: Option<[f64; 3]>,
}

/// Records the corners of `t`, not common to both, that lie on `of`.
fn vertices_on(
    of: &Triangle,
    t: &Triangle,
    sides: &[Sign; 3],
    out: &mut Collector,
) -> Result<OnTriangle, Error> {
    let mut found = OnTriangle { count: 0, first: None, last: None };
    for k in (0..3).filter(|&k| sides[k] == Sign::Zero && !of.ids.contains(&t.ids[k])) {
        let Some(projection) = of.projection else {
            return Ok(found);
        };
        let location = locate_in_plane(of, &projection, &t.corners[k]);
        if record_vertex(of, t.ids[k], location, out)? {
            found.count += 1;
            found.first = found.first.or(Some(t.corners[k]));
            found.last = Some(t.corners[k]);
        }
    }
    Ok(found)
}
