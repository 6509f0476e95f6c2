//! Contacts within one plane: two coplanar triangles, and a line segment in a triangle's plane.
//!
//! Interiors of two convex polygons are disjoint exactly when the line of an edge of one of them separates them.
use crate::error::{DefectKind, Error};
use crate::plc::intersect::collector::Collector;
use crate::plc::intersect::locate_point::{locate_in_plane, Location, Projection, Triangle};
use crate::predicates::Sign;

/// Classifies two coplanar triangles that do not have all corners in common.
pub(super) fn classify(a: &Triangle, b: &Triangle, out: &mut Collector) -> Result<(), Error> {
    let (Some(in_a), Some(in_b)) = (a.projection, b.projection) else {
        return Ok(());
    };
    vertex_contacts(a, &in_a, b, out)?;
    vertex_contacts(b, &in_b, a, out)?;
    if separates(a, &in_a, b) || separates(b, &in_b, a) {
        return Ok(());
    }
    out.triangles(DefectKind::Overlap, a, b, point_of_overlap(a, b))
}

/// Whether the line of one of `a`'s edges has all of `b` on its outer side (or on it).
fn separates(a: &Triangle, projection: &Projection, b: &Triangle) -> bool {
    (0..3).any(|k| {
        let [p, q] = a.edge_points(k);
        b.corners.iter().all(|r| projection.turn(p, q, r) != Sign::Positive)
    })
}

/// Records where corners of `b` lie on `a`.
fn vertex_contacts(
    a: &Triangle,
    projection: &Projection,
    b: &Triangle,
    out: &mut Collector,
) -> Result<(), Error> {
    for (&id, p) in b.ids.iter().zip(&b.corners) {
        if !a.ids.contains(&id) {
            record_vertex(a, id, locate_in_plane(a, projection, p), out)?;
        }
    }
    Ok(())
}

/// Records a vertex that lies on a triangle; returns whether it does.
pub(super) fn record_vertex(
    triangle: &Triangle,
    vertex: u32,
    location: Location,
    out: &mut Collector,
) -> Result<bool, Error> {
    match location {
        Location::Outside => return Ok(false),
        Location::Corner => {}
        Location::Edge(k) => out.vertex_on_edge(triangle.edge(k), vertex)?,
        Location::Inside => out.vertex_in_triangle(triangle.index, vertex)?,
    }
    Ok(true)
}

/// A point near the overlap: the mean of the corners of the triangle with the smaller box.
fn point_of_overlap(a: &Triangle, b: &Triangle) -> [f64; 3] {
    let spread = |t: &Triangle| -> f64 {
        (0..3)
            .map(|k| {
                let x = t.corners.map(|p| p[k]);
                x[0].max(x[1]).max(x[2]) - x[0].min(x[1]).min(x[2])
            })
            .sum()
    };
    let smaller = if spread(a) <= spread(b) { a } else { b };
    centroid(smaller)
}

/// The mean of a triangle's corners, rounded.
pub(super) fn centroid(t: &Triangle) -> [f64; 3] {
    std::array::from_fn(|k| t.corners.iter().map(|p| p[k] / 3.0).sum())
}

/// How a line segment in a triangle's plane meets it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct LineContact {
    /// It passes through the open interior.
    pub(super) through_interior: bool,
    /// Edges it crosses at an inner point of both.
    pub(super) crossed: [bool; 3],
}

/// Classifies the segment `p`–`q` in the triangle's plane.
pub(super) fn line_contact(
    triangle: &Triangle,
    projection: &Projection,
    p: &[f64; 3],
    q: &[f64; 3],
) -> LineContact {
    // Sides of the corners seen from the line, and of the ends seen from the edges.
    let corner_side: [Sign; 3] = std::array::from_fn(|k| projection.turn(p, q, &triangle.corners[k]));
    let end_sides: [[Sign; 2]; 3] = std::array::from_fn(|k| {
        let [a, b] = triangle.edge_points(k);
        [projection.turn(a, b, p), projection.turn(a, b, q)]
    });
    let line_enters = corner_side.contains(&Sign::Positive) && corner_side.contains(&Sign::Negative);
    let kept_out = end_sides.iter().any(|s| s[0] != Sign::Positive && s[1] != Sign::Positive);
    let crossed = std::array::from_fn(|k| {
        opposite(corner_side[k], corner_side[(k + 1) % 3]) && opposite(end_sides[k][0], end_sides[k][1])
    });
    LineContact { through_interior: line_enters && !kept_out, crossed }
}

/// Strictly different sides.
#[inline]
pub(super) fn opposite(x: Sign, y: Sign) -> bool {
    x != Sign::Zero && y == -x
}
