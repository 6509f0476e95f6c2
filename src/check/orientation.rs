//! Orientation: every tetrahedron is strictly positive, both with the output doubles and with the exact positions of the Steiner points.
//! (Both, since conformity and the Delaunay property concern the exact mesh, while the caller computes with the doubles. Tetrahedra
//! replaced by rounding, and those of an optimised mesh, are positive only in doubles. In the exact form, tetrahedra at points without a
//! valid position in doubles are positive only at exact positions.)
use crate::check::context::Context;
use crate::check::report::Report;
use crate::error::{DefectKind, Element};
use crate::output::Guarantee;
use crate::predicates::Sign;

/// Reports flat and inverted tetrahedra.
pub(super) fn check_orientation(context: &Context, report: &mut Report) {
    for (t, &tet) in context.mesh.tets.iter().enumerate() {
        // If no vertex was rounded, both tests are the same.
        let rounded = context.mesh.guarantee != Guarantee::Conforming
            && !context.is_replaced(t as u32)
            && tet.iter().any(|&v| !context.geometry.is_exact(v));
        let crowded = tet.iter().any(|v| context.mesh.crowded.contains(v));
        let positive = (crowded || context.geometry.orient3d_rounded(tet) == Sign::Positive)
            && (!rounded || context.geometry.orient3d(tet) == Sign::Positive);
        if !positive {
            let at = context.mesh.points[tet[0] as usize];
            report.add(DefectKind::NotPositive, Element::Tet(t as u32), None, Some(at));
        }
    }
}
