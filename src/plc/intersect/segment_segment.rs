//! Two input segments, and an isolated vertex against a segment.
use super::collector::Collector;
use super::coplanar::opposite;
use super::locate_point::{strictly_between, Projection};
use super::segment_triangle::crossing_point;
use crate::error::Error;
use crate::predicates::{orient3d, Sign};

/// Classifies two input segments (id, ends). Equal or overlapping ones are legal: their ends split each other.
pub(super) fn classify(
    points: &[[f64; 3]],
    (s, [p, q]): (u32, [u32; 2]),
    (t, [a, b]): (u32, [u32; 2]),
    out: &mut Collector,
) -> Result<(), Error> {
    for v in [a, b] {
        classify_vertex(points, v, (s, [p, q]), out)?;
    }
    for v in [p, q] {
        classify_vertex(points, v, (t, [a, b]), out)?;
    }
    if p == a || p == b || q == a || q == b {
        return Ok(());
    }
    let [p, q, a, b] = [p, q, a, b].map(|v| &points[v as usize]);
    if orient3d(p, q, a, b) != Sign::Zero {
        return Ok(());
    }
    // A proper crossing leaves no three of the four points on a line, so (p, q, a) then has a projection, good for the whole plane.
    let Some(projection) = Projection::of(&[*p, *q, *a]) else {
        return Ok(());
    };
    let cross = opposite(projection.turn(p, q, a), projection.turn(p, q, b))
        && opposite(projection.turn(a, b, p), projection.turn(a, b, q));
    if cross {
        out.segments(s, t, crossing_point(p, q, a, b))?;
    }
    Ok(())
}

/// Records a vertex strictly inside a segment.
pub(super) fn classify_vertex(
    points: &[[f64; 3]],
    vertex: u32,
    (segment, ends): (u32, [u32; 2]),
    out: &mut Collector,
) -> Result<(), Error> {
    let [p, q] = ends.map(|v| &points[v as usize]);
    if !ends.contains(&vertex) && strictly_between(&points[vertex as usize], p, q) {
        out.vertex_on_segment(segment, vertex)?;
    }
    Ok(())
}
