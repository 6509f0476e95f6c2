//! Failed attempts, so that none is repeated in vain.
//!
//! An attempt is a function of the tetrahedra that it reads. As long as none of them has been replaced, it would end as before, so skipping
//! it changes no result. Every user of this module must satisfy that.
use crate::error::Error;
use crate::fallible;
use crate::kernel::Mesh;
use rustc_hash::FxHashMap;

/// Per point, when an attempt at it failed, and what that had looked at. Looked up only, never iterated.
#[derive(Default)]
pub struct Memory {
    failed: FxHashMap<u32, (u64, Vec<u32>)>,
}

impl Memory {
    /// Whether an attempt at a point would fail as the last one did.
    pub fn knows(&self, mesh: &Mesh, point: u32) -> bool {
        let known = self.failed.get(&point);
        known.is_some_and(|(since, read)| read.iter().all(|&t| mesh.is_unchanged(t, *since)))
    }

    /// Takes note of an attempt that failed.
    ///
    /// # Errors
    /// [`Status::OutOfMemory`](crate::Status::OutOfMemory).
    pub fn note(&mut self, mesh: &Mesh, point: u32, read: &[u32]) -> Result<(), Error> {
        let mut list: Vec<u32> = fallible::copied(read)?;
        list.sort_unstable();
        list.dedup();
        // No larger than necessary, since there can be many.
        let list = fallible::copied(&list)?;
        fallible::insert(&mut self.failed, point, (mesh.changes(), list))?;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failure_is_known_until_what_it_read_changes() {
        let mut mesh = Mesh::stamped(3, vec![0, 3, 1]);
        let mut memory = Memory::default();
        assert!(!memory.knows(&mesh, 7));
        memory.note(&mesh, 7, &[1, 2, 2, 5]).unwrap();
        assert!(memory.knows(&mesh, 7) && !memory.knows(&mesh, 8));
        mesh = Mesh::stamped(4, vec![4, 3, 1]);
        assert!(memory.knows(&mesh, 7));
        mesh = Mesh::stamped(4, vec![4, 3, 4]);
        assert!(!memory.knows(&mesh, 7));
        memory.note(&mesh, 7, &[2]).unwrap();
        assert!(memory.knows(&mesh, 7));
    }
}
