//! The audit of every run: checks, in linear time, the guarantees that rounding or renumbering could break.
//!
//! Input points bit for bit; every tetrahedron strictly positive, in exact arithmetic on the output doubles; neighbours mutual, sharing
//! three vertices; subfaces on the tetrahedra they name. That the mesh is constrained Delaunay and covers the facets follows from the
//! algorithm; [`check_mesh`](crate::check::check_mesh) proves it independently. The guarantees of mode preserve are audited in
//! [`promise`](crate::check::promise).
use crate::check::report::Report;
use crate::control::{blocks, Control};
use crate::error::{DefectKind, Element, Error, Status};
use crate::output::TetMesh;
use crate::plc::Plc;
use crate::predicates::{orient3d, range_scale, scale, Sign};
use crate::INVALID;

/// Checks the properties that every result must have.
///
/// # Errors
/// [`Status::CheckFailed`] with the defects, of which at most `max_defects` are listed; [`Status::CoordinateRange`],
/// [`Status::OutOfMemory`].
pub fn audit(plc: &Plc, mesh: &TetMesh, max_defects: usize, control: &Control) -> Result<(), Error> {
    let mut report = Report::new(max_defects);
    audit_points(plc, mesh, &mut report);
    audit_orientation(mesh, &mut report, control)?;
    audit_neighbors(mesh, &mut report, control)?;
    audit_subfaces(mesh, &mut report);
    report.finish()
}

fn audit_points(plc: &Plc, mesh: &TetMesh, report: &mut Report) {
    for (i, p) in plc.points.iter().enumerate() {
        let same = mesh.points.get(i).is_some_and(|q| (0..3).all(|k| p[k].to_bits() == q[k].to_bits()));
        if !same {
            report.add(DefectKind::PointMoved, Element::Point(i as u32), None, Some(*p));
        }
    }
}

fn audit_orientation(mesh: &TetMesh, report: &mut Report, control: &Control) -> Result<(), Error> {
    let exponent = range_scale(&mesh.points)
        .map_err(|i| Error::new(Status::CoordinateRange, format_args!("point {i} is out of range")))?;
    // Points in range are read in place: a copy would coexist with the mesh at its peak size.
    let scaled = |v: u32| match exponent {
        0 => mesh.points[v as usize],
        _ => mesh.points[v as usize].map(|x| scale(x, exponent)),
    };
    for block in blocks(mesh.tets.len()) {
        control.step()?;
        for (t, &tet) in (block.start..block.end).zip(&mesh.tets[block]) {
            let [p, q, r, s] = tet.map(scaled);
            // The caller asked for the exact form, and the result lists these points.
            let is_bad =
                orient3d(&p, &q, &r, &s) != Sign::Positive && !tet.iter().any(|v| mesh.crowded.contains(v));
            if is_bad {
                let at = mesh.points[tet[0] as usize];
                report.add(DefectKind::NotPositive, Element::Tet(t as u32), None, Some(at));
            }
        }
    }
    Ok(())
}

fn audit_neighbors(mesh: &TetMesh, report: &mut Report, control: &Control) -> Result<(), Error> {
    for block in blocks(mesh.tets.len()) {
        control.step()?;
        for (t, tet) in (block.start..block.end).zip(&mesh.tets[block]) {
            audit_neighbors_of(mesh, t, tet, report);
        }
    }
    Ok(())
}

#[inline(always)]
fn audit_neighbors_of(mesh: &TetMesh, t: usize, tet: &[u32; 4], report: &mut Report) {
    for f in 0..4 {
        let n = mesh.neighbors[t][f];
        if n == INVALID || (n as usize) < t {
            continue;
        }
        let other = &mesh.tets[n as usize];
        let mutual = mesh.neighbors[n as usize]
            .iter()
            .zip(other)
            .any(|(&back, v)| back == t as u32 && !tet.contains(v));
        let shared = (0..4).all(|k| (k == f) != other.contains(&tet[k]));
        if !mutual || !shared {
            report.add(
                DefectKind::NotConforming,
                Element::Tet(t as u32),
                Some(Element::Tet(n)),
                Some(mesh.points[tet[0] as usize]),
            );
        }
    }
}

fn audit_subfaces(mesh: &TetMesh, report: &mut Report) {
    for subface in &mesh.subfaces {
        if subface.tets[0] == INVALID {
            report.add(DefectKind::FacetMissing, Element::Facet(subface.facet), None, None);
        }
        for t in subface.tets.into_iter().filter(|&t| t != INVALID) {
            if !subface.corners.iter().all(|v| mesh.tets[t as usize].contains(v)) {
                report.add(
                    DefectKind::FacetMissing,
                    Element::Facet(subface.facet),
                    Some(Element::Tet(t)),
                    None,
                );
            }
        }
    }
}
