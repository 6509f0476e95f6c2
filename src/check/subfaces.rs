//! Subfaces: each is a face of the mesh, listed once, with the marker of its facet and the correct tetrahedra on both sides, in the correct
//! order.
use crate::check::carved::is_carved;
use crate::check::context::Context;
use crate::check::faces::{face_corners, sorted};
use crate::check::report::Report;
use crate::error::{DefectKind, Element, Error};
use crate::fallible;
use crate::output::{Region, Subface};
use crate::INVALID;

/// Checks the subfaces; returns for each tetrahedron one bit per face that lies on a facet.
pub(super) fn check_subfaces(context: &Context, report: &mut Report) -> Result<Vec<u8>, Error> {
    let mut flags = fallible::filled(0u8, context.mesh.tets.len())?;
    if !context.subfaces_known() {
        flag_known_faces(context, &mut flags);
        return Ok(flags);
    }
    for face in &context.mesh.unmeshed_subfaces {
        if !is_carved(context, face) || face.marker != context.plc.facet_marker(face.facet as usize) {
            let at = context.position(face.corners[0]);
            report.add(DefectKind::NotConforming, Element::Facet(face.facet), None, at);
        }
    }
    for face in &context.mesh.subfaces {
        let entries = context.faces.find(face.corners);
        let element = Element::Facet(face.facet);
        let at = context.position(face.corners[0]);
        if entries.is_empty() {
            report.add(DefectKind::FacetMissing, element, None, at);
            continue;
        }
        let twice = entries.iter().any(|e| flags[e.handle as usize / 4] >> (e.handle % 4) & 1 == 1);
        let marker = context.plc.facet_marker(face.facet as usize);
        if twice || marker != face.marker || face.tets != sides(context, face) || is_reversed(context, face) {
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
        // If the parities are equal, the tetrahedron (corners, its fourth vertex) is positive.
        let positive = sorted(face_corners(context.mesh.tets[t as usize], f)).1 == odd;
        tets[usize::from(positive)] = t;
    }
    tets
}

/// Whether the first tetrahedron is the wrong one: it should be the one in the lower region or, within one region, the one with the lower
/// index. Regions are numbered in the order of their seeds, those without a seed last. Files do not distinguish regions whose seeds have
/// equal attributes, so their order is not checked.
fn is_reversed(context: &Context, face: &Subface) -> bool {
    let [s, t] = face.tets;
    if s == INVALID || t == INVALID {
        return s == INVALID;
    }
    let region = |t: u32| {
        let index = *context.mesh.tet_region.get(t as usize)?;
        Some((index, context.mesh.regions.get(index as usize)?))
    };
    let (Some((r, first)), Some((q, second))) = (region(s), region(t)) else { return false };
    if r == q {
        return s > t;
    }
    let is_known = |region: &Region| {
        region.seed != INVALID || context.plc.regions.iter().all(|seed| seed.attribute != region.attribute)
    };
    if !is_known(first) || !is_known(second) {
        return false;
    }
    let order = first.seed.cmp(&second.seed).then(first.attribute.total_cmp(&second.attribute));
    order.is_gt()
}

/// Without parents, the faces known to lie on a facet are the listed ones, the input triangles that are faces, and, since nothing
/// contradicts it here, the boundary.
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
