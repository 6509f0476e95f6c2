//! Array shapes and index ranges. A mesh from a file may contain anything: all later checks rely on this one, and do not run if it finds a
//! defect.
use crate::check::geometry::parameters;
use crate::check::report::Report;
use crate::error::{DefectKind, Element};
use crate::output::TetMesh;
use crate::plc::Plc;
use crate::predicates::is_parameter;
use crate::INVALID;

/// Reports every index that refers to no element, every non-finite coordinate and every array of the wrong length.
pub(super) fn check_arrays(plc: &Plc, mesh: &TetMesh, report: &mut Report) {
    check_plc(plc, report);
    check_lengths(plc, mesh, report);
    let points = mesh.points.len();
    for (i, p) in mesh.points.iter().enumerate() {
        if p.iter().any(|x| !x.is_finite()) {
            report.add(DefectKind::NonFinite, Element::Point(i as u32), None, None);
        }
    }
    let tets = mesh.tets.len();
    let tet_or_none = |t: u32| t == INVALID || (t as usize) < tets;
    for (t, tet) in mesh.tets.iter().enumerate() {
        if tet.iter().any(|&v| v as usize >= points) {
            bad_index(report, Element::Tet(t as u32));
        }
    }
    for (t, near) in mesh.neighbors.iter().enumerate() {
        if !near.iter().all(|&n| tet_or_none(n)) {
            bad_index(report, Element::Tet(t as u32));
        }
    }
    for (t, &region) in mesh.tet_region.iter().enumerate() {
        if region as usize >= mesh.regions.len() {
            bad_index(report, Element::Tet(t as u32));
        }
    }
    for &v in mesh.unmeshed_points.iter().filter(|&&v| v as usize >= points) {
        bad_index(report, Element::Point(v));
    }
    for &t in mesh.replaced.iter().filter(|&&t| t as usize >= tets) {
        bad_index(report, Element::Tet(t));
    }
    for pair in mesh.replaced.windows(2).filter(|pair| pair[0] >= pair[1]) {
        bad_index(report, Element::Tet(pair[1]));
    }
    check_parents(plc, mesh, report);
}

/// Checks subfaces, subsegments and Steiner points: their corners, and the elements that they claim to lie on.
fn check_parents(plc: &Plc, mesh: &TetMesh, report: &mut Report) {
    let (points, tets) = (mesh.points.len(), mesh.tets.len());
    let tet_or_none = |t: u32| t == INVALID || (t as usize) < tets;
    for face in mesh.subfaces.iter().chain(&mesh.unmeshed_subfaces) {
        let corners_ok = face.corners.iter().all(|&v| (v as usize) < points);
        let facet_ok = face.facet == INVALID || (face.facet as usize) < plc.facet_count();
        if !corners_ok || !facet_ok || !face.tets.iter().all(|&t| tet_or_none(t)) {
            bad_index(report, Element::Facet(face.facet));
        }
    }
    let segment_or_none = |s: u32| s == INVALID || (s as usize) < plc.segments.len();
    for edge in mesh.subsegments.iter().chain(&mesh.unmeshed_subsegments) {
        if edge.ends.iter().any(|&v| v as usize >= points) || !segment_or_none(edge.segment) {
            bad_index(report, Element::Segment(edge.segment));
        }
    }
    let point = |i: usize| Element::Point((plc.points.len() + i) as u32);
    let known = |i: u32| (i as usize) < mesh.steiner.len();
    if !mesh.steiner.iter().all(|s| s.t.is_finite())
        || !mesh.steiner_terms.iter().all(|x| x.value.is_finite())
    {
        report.add(DefectKind::NonFinite, point(0), None, None);
        return;
    }
    for term in mesh.steiner_terms.iter().filter(|term| !known(term.steiner)) {
        bad_index(report, point(term.steiner as usize));
    }
    for pair in mesh.steiner_terms.windows(2).filter(|pair| pair[0].steiner > pair[1].steiner) {
        bad_index(report, point(pair[1].steiner as usize));
    }
    for (i, (steiner, t)) in mesh.steiner.iter().zip(parameters(mesh)).enumerate() {
        let ends_ok = steiner.ends.iter().all(|&v| (v as usize) < plc.points.len());
        // A point inside lies at its doubles: it has no parents and no parameter.
        if steiner.is_inside() && steiner.segment == INVALID && steiner.exact {
            continue;
        }
        if steiner.facet != INVALID {
            let frame = [steiner.ends[0], steiner.ends[1], steiner.third];
            let at_doubles = frame == [INVALID; 3] && steiner.exact;
            let on_frame = frame.iter().all(|&v| (v as usize) < plc.points.len());
            let facet_ok = (steiner.facet as usize) < plc.facet_count() && steiner.segment == INVALID;
            if !facet_ok || !at_doubles && !on_frame || !steiner.u.is_finite() {
                bad_index(report, point(i));
            }
            continue;
        }
        if !ends_ok || !segment_or_none(steiner.segment) || !is_parameter(&t) {
            bad_index(report, point(i));
        }
    }
}

/// Checks the indices of the PLC itself: the input may never have been validated.
fn check_plc(plc: &Plc, report: &mut Report) {
    let points = plc.points.len();
    for (i, segment) in plc.segments.iter().enumerate() {
        if segment.ends.iter().any(|&v| v as usize >= points) {
            bad_index(report, Element::Segment(i as u32));
        }
    }
    for (i, triangle) in plc.triangles.iter().enumerate() {
        if triangle.iter().any(|&v| v as usize >= points) {
            bad_index(report, Element::Facet(i as u32));
        }
    }
    for (i, facet) in plc.facets.iter().enumerate() {
        if facet.polygons.iter().flatten().any(|&v| v as usize >= points) {
            bad_index(report, Element::Facet((plc.triangles.len() + i) as u32));
        }
    }
}

/// Parallel arrays must have equal lengths.
fn check_lengths(plc: &Plc, mesh: &TetMesh, report: &mut Report) {
    let (inputs, points, tets) = (plc.points.len(), mesh.points.len(), mesh.tets.len());
    // The first input point missing from the mesh.
    if points < inputs {
        report.add(DefectKind::PointMoved, Element::Point(points as u32), None, None);
        report.note(format_args!("the mesh has {points} points, but the input has {inputs}"));
    }
    let pairs = [
        ("neighbors", mesh.neighbors.len(), tets),
        ("tet_region", mesh.tet_region.len(), tets),
        ("point_alias", mesh.point_alias.len(), inputs),
        ("steiner", mesh.steiner.len(), points.saturating_sub(inputs)),
    ];
    for (name, length, wanted) in pairs {
        if length != 0 && length != wanted {
            report.add(DefectKind::IndexOutOfRange, Element::Tet(length.min(wanted) as u32), None, None);
            report.note(format_args!("{name} has {length} entries instead of {wanted}"));
        }
    }
    for (what, length) in [("points", points), ("tetrahedra", tets)] {
        if length >= (1 << 30) {
            report.add(DefectKind::IndexOutOfRange, Element::Tet(1 << 30), None, None);
            report.note(format_args!("more than 2^30 {what}"));
        }
    }
}

fn bad_index(report: &mut Report, element: Element) {
    report.add(DefectKind::IndexOutOfRange, element, None, None);
}
