//! Checks the invariants of [`Mesh`]: topology, and what hangs on it.
use crate::kernel::around::EdgeRing;
use crate::kernel::{flag, Mesh, GHOST, NONE};

/// `Ok`, or a description of what is wrong with the topology.
pub fn check_topology(mesh: &Mesh) -> Result<(), String> {
    for t in 0..mesh.slot_count() as u32 {
        if !mesh.is_live(t) {
            continue;
        }
        let v = mesh.verts(t);
        if v[..3].contains(&GHOST) {
            return Err(format!("tetrahedron {t}: ghost vertex outside slot 3"));
        }
        if (0..4).any(|i| (0..i).any(|j| v[i] == v[j])) {
            return Err(format!("tetrahedron {t}: repeated vertex {v:?}"));
        }
        if mesh.flags[t as usize] & (flag::MARK | flag::MET) != 0 {
            return Err(format!("tetrahedron {t}: left marked"));
        }
        for f in 0..4 {
            let c = 4 * t + f;
            let n = mesh.across(c);
            if (n >> 2) as usize >= mesh.slot_count() || !mesh.is_live(n >> 2) {
                return Err(format!("tetrahedron {t}: neighbour {f} is not live"));
            }
            if mesh.across(n) != c {
                return Err(format!("tetrahedron {t}: neighbour {f} does not point back"));
            }
            let (mut a, mut b) = (mesh.face(c), mesh.face(n));
            // Opposite orientations: the face read from the other side is an odd permutation.
            let odd = (0..3).any(|k| a[0] == b[k] && a[1] == b[(k + 2) % 3] && a[2] == b[(k + 1) % 3]);
            a.sort_unstable();
            b.sort_unstable();
            if a != b || !odd {
                return Err(format!("tetrahedron {t}: face {f} {a:?} differs from its neighbour's {b:?}"));
            }
            if mesh.is_subface(c) != mesh.is_subface(n) {
                return Err(format!("tetrahedron {t}: face {f} is a subface on one side only"));
            }
        }
    }
    Ok(())
}

/// `Ok`, or a description of what is wrong with regions, names of subfaces, subsegments, or the tetrahedra of vertices.
pub fn check_attachments(mesh: &Mesh) -> Result<(), String> {
    for t in mesh.all().filter(|&t| mesh.is_live(t)) {
        let ghost = mesh.is_ghost(t);
        if !mesh.region.is_empty() && ghost && mesh.region(t) != NONE {
            return Err(format!("ghost {t} has region {}", mesh.region(t)));
        }
        for code in 4 * t..4 * t + 4 {
            let n = mesh.across(code);
            if mesh.subface(code) != mesh.subface(n) {
                return Err(format!(
                    "tetrahedron {t}: the subface of face {:?} has two names",
                    mesh.face(code)
                ));
            }
            let apart = !ghost && !mesh.is_ghost(n >> 2) && mesh.region(t) != mesh.region(n >> 2);
            if apart && !mesh.is_subface(code) {
                return Err(format!("tetrahedron {t}: another region beyond face {:?}", mesh.face(code)));
            }
        }
        for [a, b] in mesh.subsegments(t) {
            let ring = EdgeRing::new(mesh, t, a, b);
            if ring.map(|x| x.0).any(|n| !mesh.is_subsegment(n, [a, b])) {
                return Err(format!("tetrahedron {t}: edge {:?} is not a subsegment all around", [a, b]));
            }
        }
    }
    for (v, &t) in mesh.vertex_tet.iter().enumerate().filter(|x| *x.1 != NONE) {
        if !mesh.is_live(t) || mesh.is_ghost(t) || mesh.slot_of(t, v as u32).is_none() {
            return Err(format!("vertex {v} is not in tetrahedron {t}"));
        }
    }
    Ok(())
}

impl Mesh {
    /// The free slots.
    pub fn free(&self) -> &[u32] {
        &self.free
    }

    /// Vertices, neighbours and whether it is live, of every slot.
    pub fn slots_as_they_are(&self) -> Vec<([u32; 4], [u32; 4], bool)> {
        self.all().map(|t| (self.verts(t), self.adj(t), self.is_live(t))).collect()
    }
}
