//! Subfaces: each is a face of the mesh, listed once, with the marker of its facet and the right tetrahedra on both sides.
use super::carved::is_carved;
use super::context::Context;
use super::faces::{face_corners, sorted};
use super::report::Report;
use crate::error::{DefectKind, Element, Error};
use crate::output::Subface;
use crate::INVALID;

/// Checks the subfaces; returns per tetrahedron one bit for each face that lies on a facet.
pub(super) fn check_subfaces(context: &Context, report: &mut Report) -> Result<Vec<u8>, Error> {
    let mut flags = Vec::new();
    flags.try_reserve_exact(context.mesh.tets.len())?;
    flags.resize(context.mesh.tets.len(), 0u8);
    if !context.subfaces_known() {
        flag_known_faces(context, &mut flags);
        return Ok(flags);
    }
    for face in &context.mesh.subfaces {
        let entries = context.faces.find(face.corners);
        let element = Element::Facet(face.facet);
        let at = context.position(face.corners[0]);
        if entries.is_empty() {
            if !is_carved(context, face) {
                report.add(DefectKind::FacetMissing, element, None, at);
            }
            continue;
        }
        let twice = entries.iter().any(|e| flags[e.handle as usize / 4] >> (e.handle % 4) & 1 == 1);
        let marker = context.plc.facet_marker(face.facet as usize);
        if twice || marker != face.marker || face.tets != sides(context, face) {
            report.add(DefectKind::NotConforming, element, None, at);
        }
        for e in entries {
            flags[e.handle as usize / 4] |= 1 << (e.handle % 4);
        }
    }
    Ok(flags)
}

/// The tetrahedra at a face: on the negative side of its corners, and on the positive side.
fn sides(context: &Context, face: &Subface) -> [u32; 2] {
    let mut tets = [INVALID; 2];
    let odd = sorted(face.corners).1;
    for e in context.faces.find(face.corners) {
        let (t, f) = (e.handle / 4, e.handle as usize % 4);
        // Equal parity: the tetrahedron (corners, its fourth vertex) is positive.
        let positive = sorted(face_corners(context.mesh.tets[t as usize], f)).1 == odd;
        tets[usize::from(positive)] = t;
    }
    tets
}

/// Without parents, the faces known to lie on a facet are those listed, the input triangles that are faces, and (nothing here
/// contradicts it) the boundary.
fn flag_known_faces(context: &Context, flags: &mut [u8]) {
    for (_, run) in context.faces.runs() {
        if let [only] = run {
            flags[only.handle as usize / 4] |= 1 << (only.handle % 4);
        }
    }
    let triangles = context.plc.triangles.iter().map(|t| t.map(|v| context.alias(v)));
    for corners in triangles.chain(context.mesh.subfaces.iter().map(|face| face.corners)) {
        for e in context.faces.find(corners) {
            flags[e.handle as usize / 4] |= 1 << (e.handle % 4);
        }
    }
}
