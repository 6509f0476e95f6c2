//! Two input segments, and an isolated vertex against a segment.
use crate::error::Error;
use crate::plc::intersect::collector::Collector;
use crate::plc::intersect::coplanar::opposite;
use crate::plc::intersect::locate_point::{Projection, Segment};
use crate::plc::intersect::segment_triangle::crossing_point;
use crate::predicates::{orient3d, Sign};

/// Classifies two input segments. Equal or overlapping ones are legal: their ends split each other.
pub(super) fn classify(s: &Segment, t: &Segment, out: &mut Collector) -> Result<(), Error> {
    for (one, other) in [(s, t), (t, s)] {
        for (&id, p) in other.ids.iter().zip(&other.ends) {
            classify_vertex(id, p, one, out)?;
        }
    }
    if s.ids.iter().any(|id| t.ids.contains(id)) {
        return Ok(());
    }
    let ([p, q], [a, b]) = (&s.ends, &t.ends);
    if orient3d(p, q, a, b) != Sign::Zero {
        return Ok(());
    }
    // In a proper crossing no three of the four points are collinear, so (p, q, a) has a projection, which is valid for the whole plane.
    let Some(projection) = Projection::of(&[*p, *q, *a]) else {
        return Ok(());
    };
    let cross = opposite(projection.turn(p, q, a), projection.turn(p, q, b))
        && opposite(projection.turn(a, b, p), projection.turn(a, b, q));
    if cross {
        out.segments(s.index, t.index, crossing_point(p, q, a, b))?;
    }
    Ok(())
}

/// Records a vertex strictly inside a segment.
pub(super) fn classify_vertex(
    id: u32,
    p: &[f64; 3],
    segment: &Segment,
    out: &mut Collector,
) -> Result<(), Error> {
    if segment.holds(id, p) {
        out.vertex_on_segment(segment.index, id)?;
    }
    Ok(())
}
