//! Checks the topological invariants of [`Tetrahedra`].
use crate::kernel::{flag, Tetrahedra, GHOST};

/// `Ok`, or a description of what is wrong with the topology.
pub fn check_topology(mesh: &Tetrahedra) -> Result<(), String> {
    for t in 0..mesh.slot_count() as u32 {
        if !mesh.is_live(t) {
            continue;
        }
        let v = mesh.verts[t as usize];
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
            let subface = |c: u32| mesh.flags[(c >> 2) as usize] & (flag::FACE << (c & 3)) != 0;
            if subface(c) != subface(n) {
                return Err(format!("tetrahedron {t}: face {f} is a subface on one side only"));
            }
        }
    }
    Ok(())
}
