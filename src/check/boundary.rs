//! The boundary of the mesh: faces of only one tetrahedron lie on facets; if the hull was kept, the others form a convex boundary.
use crate::check::context::Context;
use crate::check::faces::{face_corners, FACE};
use crate::check::report::Report;
use crate::error::{DefectKind, Element};
use crate::predicates::Sign;
use crate::INVALID;

/// Reports boundary faces off the facets; `subfaces` has a bit per face of each tetrahedron.
pub(super) fn check_boundary(
    context: &Context,
    adjacency: &[[u32; 4]],
    subfaces: &[u8],
    report: &mut Report,
) {
    for (t, near) in adjacency.iter().enumerate() {
        for face in 0..4 {
            if near[face] != INVALID || subfaces[t] >> face & 1 == 1 {
                continue;
            }
            if !context.mesh.hull_kept || !convex_at(context, adjacency, t, face) {
                let at = context.position(context.mesh.tets[t][FACE[face][0]]);
                report.add(DefectKind::HullOffFacets, Element::Tet(t as u32), None, at);
            }
        }
    }
}

/// Whether the boundary is nowhere reflex around a boundary face: turning around each of its edges through the inside of the mesh, the next
/// boundary face is reached after at most half a turn.
fn convex_at(context: &Context, adjacency: &[[u32; 4]], t: usize, face: usize) -> bool {
    let tets = &context.mesh.tets;
    let corners = face_corners(tets[t], face);
    (0..3).all(|k| {
        let edge = [corners[k], corners[(k + 1) % 3]];
        let (mut tet, mut from) = (t, face);
        // Turn by leaving each tetrahedron through its other face at the edge. The number of tetrahedra bounds the loop if the ring is
        // damaged.
        for _ in 0..tets.len() {
            let other = |i: usize| i != from && !edge.contains(&tets[tet][i]);
            let Some(leave) = (0..4).find(|&i| other(i)) else { return false };
            let apex = tets[tet][from];
            let near = adjacency[tet][leave];
            if near == INVALID {
                let [a, b, c] = corners;
                return context.geometry.orient3d([a, b, c, apex]) != Sign::Negative;
            }
            (tet, from) = (near as usize / 4, near as usize % 4);
        }
        false
    })
}
