//! Local Delaunay property: across every interior face that is no subface, the vertex beyond is not strictly inside the
//! circumsphere (with weights: its power is not negative). Cospherical vertices (which the mesher decides by symbolic perturbation) are no violation.
//!
//! Faces of tetrahedra replaced by rounding are only counted.
//!
//! By the constrained Delaunay lemma (Shewchuk 2008, "General-dimensional constrained Delaunay and constrained regular triangulations",
//! section 3) this local property of all faces is the global one.
use crate::check::context::Context;
use crate::check::report::Report;
use crate::error::{DefectKind, Element};
use crate::predicates::Sign;
use crate::INVALID;

/// Reports faces that are not locally Delaunay; `subfaces` has a bit per face of each tetrahedron.
pub(super) fn check_delaunay(
    context: &Context,
    adjacency: &[[u32; 4]],
    subfaces: &[u8],
    report: &mut Report,
) {
    if context.weights_unknown() {
        report.note(format_args!("the mesh has no weights: whether it is weighted Delaunay was not judged"));
        return;
    }
    let tets = &context.mesh.tets;
    let (mut rounded, mut replaced) = (0usize, 0usize);
    for (t, near) in adjacency.iter().enumerate() {
        for (face, &n) in near.iter().enumerate() {
            if n == INVALID || n as usize / 4 < t || subfaces[t] >> face & 1 == 1 {
                continue;
            }
            let apex = tets[n as usize / 4][n as usize % 4];
            if context.geometry.in_conflict(tets[t], apex) != Sign::Positive {
                continue;
            }
            if context.is_replaced(t as u32) || context.is_replaced(n / 4) {
                replaced += 1;
            } else if context.parents_known
                || tets[t].iter().all(|&v| context.is_input(v)) && context.is_input(apex)
            {
                let at = context.mesh.points[apex as usize];
                report.add(
                    DefectKind::NotDelaunay,
                    Element::Tet(t as u32),
                    Some(Element::Tet(n / 4)),
                    Some(at),
                );
            } else {
                rounded += 1;
            }
        }
    }
    if replaced > 0 {
        report.note(format_args!(
            "{replaced} faces of tetrahedra replaced by rounding are not locally Delaunay"
        ));
    }
    if rounded > 0 {
        report.note(format_args!(
            "{rounded} faces at points with unknown parents are not locally Delaunay at their rounded coordinates"
        ));
    }
}
