//! Checks that a mesh is a perturbed Delaunay tetrahedralization, weighted or not.
use crate::delaunay::conflicts::ghost_in_conflict;
use crate::kernel::check::check_topology;
use crate::kernel::{Mesh, GHOST};
use crate::predicates::{Points, Sign};

/// Checks topology, orientation, and that every face is locally Delaunay, including those of ghosts (which makes the hull convex). The
/// error describes what is wrong.
pub fn check_delaunay(mesh: &Mesh, points: &Points) -> Result<(), String> {
    check_topology(mesh)?;
    for t in 0..mesh.slot_count() as u32 {
        if !mesh.is_live(t) {
            continue;
        }
        let v = mesh.verts(t);
        if !mesh.is_ghost(t) && points.orient3d(v[0], v[1], v[2], v[3]) != Sign::Positive {
            return Err(format!("tetrahedron {t} {v:?} is not positive"));
        }
        for f in 0..4 {
            let apex = mesh.apex(mesh.across(4 * t + f));
            if apex != GHOST && in_conflict(mesh, points, t, apex) {
                return Err(format!("vertex {apex} is in conflict with tetrahedron {t} {v:?}"));
            }
        }
    }
    Ok(())
}

/// Whether the (perturbed) circumsphere of `t` contains `p`; for a ghost, whether its hull face sees `p`, or `p` lies in the plane of
/// the hull face and inside the circumsphere of the finite tetrahedron behind it.
fn in_conflict(mesh: &Mesh, points: &Points, t: u32, p: u32) -> bool {
    let v = mesh.verts(t);
    if v[3] != GHOST {
        return points.power_perturbed(v, p) == Sign::Positive;
    }
    ghost_in_conflict::<true>(&mesh.slots(), points, t, p)
}
