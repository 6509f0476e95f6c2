//! Refilling cavities: replaces some tetrahedra by others with the same boundary.
//!
//! Faces are matched by their vertices, each twice: from two new tetrahedra, or from a new tetrahedron and the one that stays beyond the
//! boundary. Most cavities are small, and searching a list of their faces is faster than hashing.
use crate::error::Error;
use crate::kernel::{face_key, flag, Tetrahedra};
use rustc_hash::{FxHashMap, FxHashSet};

/// The most tetrahedra of a small cavity.
const SMALL: usize = 32;

/// Faces that wait for their second side, with the corner code of the first.
#[derive(Default)]
struct OpenFaces {
    small: bool,
    list: Vec<([u32; 3], u32)>,
    map: FxHashMap<[u32; 3], u32>,
}

impl OpenFaces {
    /// Clears the list and makes room for the faces of `tets` tetrahedra.
    fn clear(&mut self, tets: usize) -> Result<(), Error> {
        self.small = tets <= SMALL;
        self.list.clear();
        self.map.clear();
        if self.small {
            self.list.try_reserve(4 * tets)?;
        } else {
            self.map.try_reserve(2 * tets)?;
        }
        Ok(())
    }

    fn insert(&mut self, key: [u32; 3], code: u32) {
        if self.small {
            self.list.push((key, code));
        } else {
            self.map.insert(key, code);
        }
    }

    fn remove(&mut self, key: &[u32; 3]) -> Option<u32> {
        if !self.small {
            return self.map.remove(key);
        }
        let at = self.list.iter().position(|x| x.0 == *key)?;
        Some(self.list.swap_remove(at).1)
    }

    fn is_empty(&self) -> bool {
        self.list.is_empty() && self.map.is_empty()
    }
}

/// Refills cavities, with its scratch space.
#[derive(Default)]
pub struct Refill {
    open: OpenFaces,
    constrained: FxHashSet<[u32; 3]>,
    /// The slots of the new tetrahedra, in the order given.
    pub fresh: Vec<u32>,
}

impl Refill {
    /// Replaces the tetrahedra `old` by `new`, none of them ghosts. Faces flagged as subfaces stay flagged, and `subfaces` are flagged;
    /// `vertex_tet` is kept up to date.
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
        open.clear(old.len() + new.len())?;
        constrained.clear();
        fresh.clear();
        fresh.try_reserve(new.len())?;
        mesh.reserve(new.len())?;
        for &t in old {
            mesh.flags[t as usize] |= flag::MARK;
        }
        for code in old.iter().flat_map(|&t| 4 * t..4 * t + 4) {
            let key = face_key(mesh.face(code));
            if mesh.flags[(code >> 2) as usize] & (flag::FACE << (code & 3)) != 0 {
                constrained.try_reserve(1)?;
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
                if !constrained.is_empty() && constrained.contains(&key) {
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
