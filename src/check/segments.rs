//! Segments: each input segment is a chain of mesh edges, and the listed subsegments are exactly the pieces of segments (and of facet
//! edges) that they claim to be.
use crate::check::chains::Chains;
use crate::check::context::Context;
use crate::check::report::Report;
use crate::error::{DefectKind, Element, Error};
use crate::fallible;
use crate::INVALID;

/// Reports segments that are not unions of edges, and wrong subsegments.
pub(super) fn check_segments(context: &Context, chains: &Chains, report: &mut Report) -> Result<(), Error> {
    // The (smaller end, larger end, segment) of every piece.
    let mut pieces: Vec<[u32; 3]> = Vec::new();
    let mut chain = Vec::new();
    for (i, segment) in context.plc.segments.iter().enumerate() {
        let [a, b] = segment.ends.map(|v| context.alias(v));
        if a == b {
            continue;
        }
        if chains.find(a, b, &mut chain)? {
            fallible::extend(
                &mut pieces,
                chain.windows(2).map(|w| [w[0].min(w[1]), w[0].max(w[1]), i as u32]),
            )?;
        } else if !excused(context, a, b) {
            let at = context.position(a);
            report.add(DefectKind::SegmentMissing, Element::Segment(i as u32), None, at);
        }
    }
    pieces.sort_unstable();
    check_subsegments(context, &pieces, report)
}

/// Whether a segment may be missing: one with an end that is no vertex of the mesh lies outside (the point check has verified that the end
/// does), where everything was carved.
fn excused(context: &Context, a: u32, b: u32) -> bool {
    !context.parents_known || !context.stars.used(a) || !context.stars.used(b)
}

/// Checks that each subsegment is an edge of the mesh; that a subsegment naming a segment is a piece of it and has its marker; and that
/// every piece of a segment is a subsegment of it or of an equal one.
fn check_subsegments(context: &Context, pieces: &[[u32; 3]], report: &mut Report) -> Result<(), Error> {
    let mut given: Vec<[u32; 2]> = fallible::reserved(context.subsegments.len())?;
    let meshed = context.mesh.subsegments.len();
    for (i, edge) in context.subsegments.iter().enumerate() {
        let [a, b] = edge.ends;
        let listed_right = context.stars.has_edge(&context.mesh.tets, a, b) == (i < meshed);
        let key = [a.min(b), a.max(b)];
        fallible::push(&mut given, key)?;
        let named = edge.segment == INVALID
            || pieces.binary_search(&[key[0], key[1], edge.segment]).is_ok()
                && context.plc.segments[edge.segment as usize].marker == edge.marker;
        if !context.has_edge(a, b) || !listed_right || !named {
            let element =
                if edge.segment == INVALID { Element::Point(a) } else { Element::Segment(edge.segment) };
            report.add(DefectKind::NotConforming, element, Some(Element::Point(b)), context.position(a));
        }
    }
    if given.is_empty() {
        return Ok(());
    }
    given.sort_unstable();
    for piece in pieces {
        if given.binary_search(&[piece[0], piece[1]]).is_err() {
            let at = context.position(piece[0]);
            report.add(DefectKind::SegmentMissing, Element::Segment(piece[2]), None, at);
        }
    }
    Ok(())
}
