//! A line segment against a triangle: where it pierces the triangle, and contacts of input segments and isolated vertices.
//!
//! A segment whose ends lie strictly on different sides of the plane meets the triangle if its line passes all three edges on the same side
//! (Segura & Feito 2001).
use crate::elementary::quotient;
use crate::error::Error;
use crate::plc::intersect::collector::Collector;
use crate::plc::intersect::coplanar::{line_contact, opposite, record_vertex};
use crate::plc::intersect::locate_point::{locate_in_plane, Location, Segment, Triangle};
use crate::predicates::{orient3d, Sign};
use crate::vector::{cross, dot, sub};

/// Where the open segment `p`–`q`, with ends strictly on the sides `side_p` and `−side_p` of the plane, meets the triangle.
pub(super) fn pierce(triangle: &Triangle, p: &[f64; 3], q: &[f64; 3], side_p: Sign) -> Location {
    Location::from_sides(std::array::from_fn(|k| {
        let [a, b] = triangle.edge_points(k);
        // With p above (positive side) and q below, the line passes on the inner side of a–b when (q, p, a, b) is positive.
        match side_p {
            Sign::Positive => orient3d(q, p, a, b),
            _ => orient3d(p, q, a, b),
        }
    }))
}

/// Classifies an input segment and a triangle.
pub(super) fn classify(segment: &Segment, triangle: &Triangle, out: &mut Collector) -> Result<(), Error> {
    let shared = segment.ids.map(|id| triangle.ids.contains(&id));
    if shared == [true, true] {
        return Ok(());
    }
    let [p, q] = &segment.ends;
    let side = |end: usize, p: &[f64; 3]| if shared[end] { Sign::Zero } else { triangle.side(p) };
    let sides = [side(0, p), side(1, q)];
    match sides {
        [Sign::Zero, Sign::Zero] => classify_coplanar(segment, triangle, out),
        [side_p, side_q] if opposite(side_p, side_q) => match pierce(triangle, p, q, side_p) {
            Location::Outside => Ok(()),
            Location::Corner => corners_on_segment(segment, triangle, out),
            Location::Edge(k) => {
                out.edge_crossed(segment.index, triangle, k, false, piercing_point(triangle, p, q))
            }
            Location::Inside => out.pierced(segment.index, triangle, piercing_point(triangle, p, q)),
        },
        _ => {
            for end in 0..2 {
                if sides[end] == Sign::Zero && !shared[end] {
                    classify_vertex(segment.ids[end], &segment.ends[end], triangle, out)?;
                }
            }
            Ok(())
        }
    }
}

fn classify_coplanar(segment: &Segment, triangle: &Triangle, out: &mut Collector) -> Result<(), Error> {
    let Some(projection) = triangle.projection else {
        return Ok(());
    };
    let [p, q] = &segment.ends;
    for (&id, p) in segment.ids.iter().zip([p, q]) {
        if !triangle.ids.contains(&id) {
            record_vertex(triangle, id, locate_in_plane(triangle, &projection, p), out)?;
        }
    }
    corners_on_segment(segment, triangle, out)?;
    let contact = line_contact(triangle, &projection, p, q);
    if contact.through_interior {
        out.segment_in_facet(segment.index, triangle.index)?;
    }
    for k in (0..3).filter(|&k| contact.crossed[k]) {
        let [a, b] = triangle.edge_points(k);
        out.edge_crossed(segment.index, triangle, k, true, crossing_point(p, q, a, b))?;
    }
    Ok(())
}

/// Records the triangle's corners that lie strictly inside the segment.
fn corners_on_segment(segment: &Segment, triangle: &Triangle, out: &mut Collector) -> Result<(), Error> {
    for (&id, corner) in triangle.ids.iter().zip(&triangle.corners) {
        if segment.holds(id, corner) {
            out.vertex_on_segment(segment.index, id)?;
        }
    }
    Ok(())
}

/// Classifies a vertex that is no corner of the triangle.
pub(super) fn classify_vertex(
    id: u32,
    p: &[f64; 3],
    triangle: &Triangle,
    out: &mut Collector,
) -> Result<(), Error> {
    if triangle.ids.contains(&id) || triangle.side(p) != Sign::Zero {
        return Ok(());
    }
    if let Some(projection) = triangle.projection {
        record_vertex(triangle, id, locate_in_plane(triangle, &projection, p), out)?;
    }
    Ok(())
}

/// The point where a line meets the triangle's plane, rounded, for reports only.
pub(super) fn piercing_point(triangle: &Triangle, p: &[f64; 3], q: &[f64; 3]) -> [f64; 3] {
    let [a, b, c] = &triangle.corners;
    let normal = cross(&sub(b, a), &sub(c, a));
    let (from, to) = (dot(&normal, &sub(p, a)), dot(&normal, &sub(q, a)));
    between(p, q, quotient(from, from - to))
}

/// The point where two crossing segments meet, rounded, for reports only.
pub(super) fn crossing_point(p: &[f64; 3], q: &[f64; 3], a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    let direction = sub(b, a);
    let normal = cross(&direction, &cross(&sub(q, p), &direction));
    let (from, to) = (dot(&normal, &sub(p, a)), dot(&normal, &sub(q, a)));
    between(p, q, quotient(from, from - to))
}

fn between(p: &[f64; 3], q: &[f64; 3], t: Option<f64>) -> [f64; 3] {
    // Rounding may give any value for nearly parallel elements: stay on the segment.
    let t = t.map_or(0.5, |t| t.clamp(0.0, 1.0));
    std::array::from_fn(|k| p[k] + t * (q[k] - p[k]))
}
