//! Orientation: every tetrahedron is strictly positive, on the doubles that were handed out and on the exact positions of
//! the Steiner points behind them. (Both, since conformity and the Delaunay property are those of the exact mesh, and what the
//! caller computes with are the doubles.)
use super::context::Context;
use super::report::Report;
use crate::error::{DefectKind, Element};
use crate::predicates::Sign;

/// Reports flat and inverted tetrahedra.
pub(super) fn check_orientation(context: &Context, report: &mut Report) {
    for (t, &tet) in context.mesh.tets.iter().enumerate() {
        let exact = || context.geometry.orient3d(tet) == Sign::Positive;
        if context.geometry.orient3d_rounded(tet) != Sign::Positive || !exact() {
            let at = context.mesh.points[tet[0] as usize];
            report.add(DefectKind::NotPositive, Element::Tet(t as u32), None, Some(at));
        }
    }
}
