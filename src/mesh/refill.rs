//! Cavities refilled: some tetrahedra go, others that have the same boundary come in their place.
//!
//! Faces are joined by their vertices, each twice: once from either side, or once from a new tetrahedron and once from the one that
//! stays beyond the boundary.
use super::{face_key, flag, Tetrahedra};
use crate::error::Error;
use rustc_hash::{FxHashMap, FxHashSet};

/// Refills; keeps its scratch space.
#[derive(Default)]
pub struct Refill {
    /// Faces that wait for their second side: corner code of the first.
    open: FxHashMap<[u32; 3], u32>,
    constrained: FxHashSet<[u32; 3]>,
    /// The slots of the new tetrahedra, in the order given.
    pub fresh: Vec<u32>,
}

impl Refill {
    /// Replaces the tetrahedra `old` by `new`, none of them ghosts. Faces flagged as subfaces stay flagged, and `subfaces`
    /// become so; `vertex_tet` is kept up to date.
    ///
    /// # Errors
    /// `Internal` if the boundaries differ (the mesh is then unusable), `OutOfMemory`, `TooLarge`.
    pub fn replace(
        &mut self,
        mesh: &mut Tetrahedra,
        vertex_tet: &mut [u32],
        old: &[u32],
        new: &[[u32; 4]],
        subfaces: impl Iterator<Item = [u32; 3]>,
    ) -> Result<(), Error> {
        let Refill { open, constrained, fresh } = self;
        open.clear();
        constrained.clear();
        fresh.clear();
        open.try_reserve(2 * (old.len() + new.len()))?;
        constrained.try_reserve(4 * old.len())?;
        fresh.try_reserve(new.len())?;
        mesh.reserve(new.len())?;
        for &t in old {
            mesh.flags[t as usize] |= flag::MARK;
        }
        for code in old.iter().flat_map(|&t| 4 * t..4 * t + 4) {
            let key = face_key(mesh.face(code));
            if mesh.flags[(code >> 2) as usize] & (flag::FACE << (code & 3)) != 0 {
                constrained.insert(key);
            }
            let n = mesh.across(code);
            if mesh.flags[(n >> 2) as usize] & flag::MARK == 0 {
                open.insert(key, n);
            }
        }
        constrained.extend(subfaces.map(face_key));
        for &t in old {
            mesh.release(t);
        }
        for &corners in new {
            let t = mesh.allocate(corners);
            fresh.push(t);
            for v in corners {
                vertex_tet[v as usize] = t;
            }
            for code in 4 * t..4 * t + 4 {
                let key = face_key(mesh.face(code));
                if constrained.contains(&key) {
                    mesh.flags[t as usize] |= flag::FACE << (code & 3);
                }
                match open.remove(&key) {
                    Some(other) => mesh.link(code, other),
                    None => {
                        open.insert(key, code);
                    }
                }
            }
        }
        if open.is_empty() {
            Ok(())
        } else {
            Err(Error::internal("the filling of a cavity does not fit its boundary"))
        }
    }
}
