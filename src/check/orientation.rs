//! Orientation: every tetrahedron is strictly positive, on the doubles that were handed out and on the exact positions of
//! the Steiner points behind them. (Both, since conformity and the Delaunay property are those of the exact mesh, and what the
//! caller computes with are the doubles. Tetrahedra that rounding had to replace are positive in doubles only; those
//! with points that have no valid position in doubles, where the caller asked for the exact form, in exact positions only.)
use super::context::Context;
use super::report::Report;
use crate::error::{DefectKind, Element};
use crate::predicates::Sign;

/// Reports flat and inverted tetrahedra.
pub(super) fn check_orientation(context: &Context, report: &mut Report) {
    for (t, &tet) in context.mesh.tets.iter().enumerate() {
        // Where no vertex was rounded the two are one question.
        let rounded = !context.is_replaced(t as u32) && tet.iter().any(|&v| !context.geometry.is_exact(v));
        let crowded = tet.iter().any(|v| context.mesh.crowded.contains(v));
        let positive = (crowded || context.geometry.orient3d_rounded(tet) == Sign::Positive)
            && (!rounded || context.geometry.orient3d(tet) == Sign::Positive);
        if !positive {
            let at = context.mesh.points[tet[0] as usize];
            report.add(DefectKind::NotPositive, Element::Tet(t as u32), None, Some(at));
        }
    }
}
