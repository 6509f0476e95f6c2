//! Checks a domain: topology, attachments and orientation. For tests.
use crate::kernel::check::{check_attachments, check_topology};
use crate::kernel::Mesh;
use crate::predicates::{Points, Sign};

/// `Ok`, or a description of what is wrong.
pub fn check_domain(mesh: &Mesh, points: &Points) -> Result<(), String> {
    check_topology(mesh)?;
    check_attachments(mesh)?;
    for t in mesh.all().filter(|&t| mesh.is_live(t) && !mesh.is_ghost(t)) {
        let verts = mesh.verts(t);
        if points.orient3d(verts[0], verts[1], verts[2], verts[3]) != Sign::Positive {
            return Err(format!("tetrahedron {t} {verts:?} is not positive"));
        }
    }
    Ok(())
}
