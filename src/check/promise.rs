//! The audit of the guarantees of [`Mode::Preserve`](crate::Mode::Preserve): every triangle of the surface is a face of the mesh, every
//! polygon is covered within its own edges, and every segment is an edge.
//!
//! What is promised is recorded before anything is removed from the surface, without the carved parts. That listed pieces of facets are
//! faces of the tetrahedra they name has been audited before. So triangles are looked up in a sorted list of these pieces: the cost depends
//! on the size of the surface, not of the mesh.
use crate::check::report::Report;
use crate::control::Control;
use crate::error::{DefectKind, Element, Error};
use crate::fallible;
use crate::output::TetMesh;

/// What must be found in the mesh, in its point indices.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Promise {
    /// Triangles of the surface, and the facet of each.
    pub triangles: Vec<([u32; 3], u32)>,
    /// Edges that bound polygons, and a facet of each.
    pub polygon_edges: Vec<([u32; 2], u32)>,
    /// Polygons, in ascending order, and how many triangles cover each: all triangulations without additional corners have equally many.
    pub polygons: Vec<(u32, u32)>,
    /// Input segments in one piece, and the index of each.
    pub segments: Vec<([u32; 2], u32)>,
}

fn sorted<const N: usize>(mut corners: [u32; N]) -> [u32; N] {
    corners.sort_unstable();
    corners
}

/// Looks up everything promised.
///
/// # Errors
/// [`Status::CheckFailed`](crate::Status::CheckFailed) with what is missing, of which at most `max_defects` are listed;
/// [`Status::OutOfMemory`](crate::Status::OutOfMemory).
pub fn audit_promise(
    mesh: &TetMesh,
    promise: &Promise,
    max_defects: usize,
    control: &Control,
) -> Result<(), Error> {
    let mut report = Report::new(max_defects);
    audit_triangles(mesh, promise, &mut report)?;
    control.look()?;
    audit_polygons(mesh, promise, &mut report)?;
    audit_segments(mesh, promise, &mut report, control)?;
    report.finish()
}

fn audit_triangles(mesh: &TetMesh, promise: &Promise, report: &mut Report) -> Result<(), Error> {
    // Mostly the pieces are listed in the order of the promise: only what breaks it is searched for.
    let mut next = mesh.subfaces.iter().map(|face| sorted(face.corners)).peekable();
    let mut rest: Vec<([u32; 3], u32)> = Vec::new();
    for &(corners, facet) in &promise.triangles {
        let corners = sorted(corners);
        if next.next_if_eq(&corners).is_none() {
            fallible::push(&mut rest, (corners, facet))?;
        }
    }
    if rest.is_empty() {
        return Ok(());
    }
    let mut faces: Vec<[u32; 3]> = fallible::collect(mesh.subfaces.iter().map(|face| sorted(face.corners)))?;
    faces.sort_unstable();
    for (corners, facet) in rest {
        if faces.binary_search(&corners).is_err() {
            let at = mesh.points.get(corners[0] as usize).copied();
            report.add(DefectKind::FacetMissing, Element::Facet(facet), None, at);
        }
    }
    Ok(())
}

fn audit_polygons(mesh: &TetMesh, promise: &Promise, report: &mut Report) -> Result<(), Error> {
    if promise.polygons.is_empty() {
        return Ok(());
    }
    let is_known = |facet: u32| promise.polygons.binary_search_by_key(&facet, |x| x.0);
    let mut counts: Vec<u32> = fallible::filled(0, promise.polygons.len())?;
    let mut edges: Vec<[u32; 2]> = Vec::new();
    for face in &mesh.subfaces {
        let Ok(i) = is_known(face.facet) else { continue };
        counts[i] += 1;
        let [a, b, c] = face.corners;
        fallible::extend(&mut edges, [sorted([a, b]), sorted([b, c]), sorted([c, a])])?;
    }
    edges.sort_unstable();
    for (&(facet, count), found) in promise.polygons.iter().zip(counts) {
        if count != found {
            report.add(DefectKind::FacetMissing, Element::Facet(facet), None, None);
        }
    }
    for &(ends, facet) in &promise.polygon_edges {
        if edges.binary_search(&sorted(ends)).is_err() {
            let at = mesh.points.get(ends[0] as usize).copied();
            report.add(DefectKind::FacetMissing, Element::Facet(facet), None, at);
        }
    }
    Ok(())
}

fn audit_segments(
    mesh: &TetMesh,
    promise: &Promise,
    report: &mut Report,
    control: &Control,
) -> Result<(), Error> {
    if promise.segments.is_empty() {
        return Ok(());
    }
    let mut missing: Vec<([u32; 2], u32)> =
        fallible::collect(promise.segments.iter().map(|&(ends, segment)| (sorted(ends), segment)))?;
    missing.sort_unstable();
    let mut found: Vec<bool> = fallible::filled(false, missing.len())?;
    let mut is_end: Vec<bool> = fallible::filled(false, mesh.points.len())?;
    missing.iter().flat_map(|x| x.0).for_each(|v| is_end[v as usize] = true);
    for tet in &mesh.tets {
        control.step()?;
        for i in 0..4 {
            for j in (i + 1..4).filter(|&j| is_end[tet[i] as usize] && is_end[tet[j] as usize]) {
                let edge = sorted([tet[i], tet[j]]);
                let from = missing.partition_point(|x| x.0 < edge);
                let equal = missing[from..].iter().take_while(|x| x.0 == edge).count();
                found[from..from + equal].fill(true);
            }
        }
    }
    for (&(ends, segment), _) in missing.iter().zip(&found).filter(|x| !*x.1) {
        let at = mesh.points.get(ends[0] as usize).copied();
        report.add(DefectKind::SegmentMissing, Element::Segment(segment), None, at);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Status;
    use crate::output::Subface;
    use crate::INVALID;

    /// Two tetrahedra at the face 0 1 2, which is a piece of facet 0 like the others of the first tetrahedron.
    fn mesh() -> TetMesh {
        let corners = [[0, 1, 2], [0, 1, 3], [1, 2, 3], [0, 2, 3]];
        let face = |(facet, corners)| Subface { corners, facet, marker: 0, tets: [0, INVALID] };
        TetMesh {
            points: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]],
            tets: vec![[0, 1, 2, 3], [0, 2, 1, 4]],
            subfaces: [0, 0, 1, 2].into_iter().zip(corners).map(face).collect(),
            ..TetMesh::default()
        }
    }

    fn promise() -> Promise {
        Promise {
            triangles: vec![([3, 2, 1], 1), ([2, 0, 3], 2)],
            polygon_edges: vec![([1, 2], 0), ([3, 0], 0)],
            polygons: vec![(0, 2)],
            segments: vec![([4, 1], 7)],
        }
    }

    fn missing(mesh: &TetMesh, promise: &Promise) -> Vec<(DefectKind, Element)> {
        match audit_promise(mesh, promise, 10, &Control::free()) {
            Ok(()) => Vec::new(),
            Err(e) => {
                assert_eq!(e.status, Status::CheckFailed);
                e.defects.iter().map(|d| (d.kind, d.first)).collect()
            }
        }
    }

    #[test]
    fn a_kept_promise_passes() {
        assert_eq!(missing(&mesh(), &promise()), []);
        assert_eq!(missing(&mesh(), &Promise::default()), []);
    }

    #[test]
    fn a_lost_triangle_is_found() {
        for lost in [2, 3] {
            let mut mesh = mesh();
            let facet = mesh.subfaces.remove(lost).facet;
            assert_eq!(missing(&mesh, &promise()), [(DefectKind::FacetMissing, Element::Facet(facet))]);
        }
        let mut promise = promise();
        promise.triangles.push(([0, 1, 4], 9));
        assert_eq!(missing(&mesh(), &promise), [(DefectKind::FacetMissing, Element::Facet(9))]);
    }

    #[test]
    fn a_polygon_that_is_not_covered_is_found() {
        let lost = [(DefectKind::FacetMissing, Element::Facet(0))];
        let mut promise = promise();
        promise.polygon_edges.push(([2, 3], 0));
        assert_eq!(missing(&mesh(), &promise), lost, "an edge");
        promise.polygon_edges.pop();
        promise.polygons = vec![(0, 3)];
        assert_eq!(missing(&mesh(), &promise), lost, "a triangle");
    }

    #[test]
    fn a_lost_segment_is_found() {
        let mut promise = promise();
        promise.segments.push(([3, 4], 8));
        assert_eq!(missing(&mesh(), &promise), [(DefectKind::SegmentMissing, Element::Segment(8))]);
    }
}
