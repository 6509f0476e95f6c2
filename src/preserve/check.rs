//! Checks the invariants of [`Solid`]: for tests.
use crate::kernel::check::check_topology;
use crate::kernel::face_key;
use crate::kernel::{flag, NONE};
use crate::predicates::{Points, Sign};
use crate::preserve::solid::Solid;
use rustc_hash::FxHashSet;

/// `Ok`, or a description of what is wrong.
pub fn check_solid(solid: &Solid, points: &Points) -> Result<(), String> {
    check_topology(&solid.mesh)?;
    let mut faces = FxHashSet::default();
    for t in (0..solid.mesh.slot_count() as u32).filter(|&t| solid.mesh.is_live(t)) {
        let verts = solid.mesh.verts[t as usize];
        let ghost = solid.mesh.is_ghost(t);
        if ghost != (solid.region[t as usize] == NONE) {
            return Err(format!("tetrahedron {t}: region {}", solid.region[t as usize]));
        }
        if !ghost && points.orient3d(verts[0], verts[1], verts[2], verts[3]) != Sign::Positive {
            return Err(format!("tetrahedron {t} {verts:?} is not positive"));
        }
        for f in 0..4 {
            let face = solid.mesh.face(4 * t + f);
            let flagged = solid.mesh.flags[t as usize] & (flag::FACE << f) != 0;
            faces.insert(face_key(face));
            if flagged != solid.patch_of.contains_key(&face_key(face)) {
                return Err(format!("tetrahedron {t}: face {face:?} has flag {flagged}"));
            }
            let n = solid.mesh.across(4 * t + f) >> 2;
            if !flagged
                && !ghost
                && !solid.mesh.is_ghost(n)
                && solid.region[t as usize] != solid.region[n as usize]
            {
                return Err(format!("tetrahedron {t}: another region beyond face {face:?}"));
            }
        }
    }
    if let Some(face) = solid.patch_of.keys().filter(|key| !faces.contains(*key)).min() {
        return Err(format!("subface {face:?} is no face"));
    }
    for (v, &t) in solid.vertex_tet.iter().enumerate().filter(|x| *x.1 != NONE) {
        if !solid.mesh.is_live(t) || solid.mesh.is_ghost(t) || solid.mesh.slot_of(t, v as u32).is_none() {
            return Err(format!("vertex {v} is not in tetrahedron {t}"));
        }
    }
    Ok(())
}
