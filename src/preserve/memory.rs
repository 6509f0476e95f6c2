//! Failed attempts, so that none is repeated in vain.
//!
//! An attempt is a function of the tetrahedra that it reads. As long as none of them has been replaced, it would end as before, so skipping
//! it changes no result. Every user of this module must satisfy that.
use crate::error::{Error, Status};
use crate::preserve::solid::Solid;
use rustc_hash::FxHashMap;

/// Per point, when an attempt at it failed, and what that had looked at. Looked up only, never iterated.
#[derive(Default)]
pub struct Memory {
    failed: FxHashMap<u32, (u64, Vec<u32>)>,
}

impl Memory {
    /// Whether an attempt at a point would fail as the last one did.
    pub fn knows(&self, solid: &Solid, point: u32) -> bool {
        let unchanged =
            |t: u32, since: u64| solid.changed.get(t as usize).is_none_or(|&changed| changed <= since);
        self.failed.get(&point).is_some_and(|(since, read)| read.iter().all(|&t| unchanged(t, *since)))
    }

    /// Takes note of an attempt that failed.
    ///
    /// # Errors
    /// [`Status::OutOfMemory`].
    pub fn note(&mut self, solid: &Solid, point: u32, read: &[u32]) -> Result<(), Error> {
        let mut list: Vec<u32> = Vec::new();
        list.try_reserve(read.len())?;
        list.extend_from_slice(read);
        list.sort_unstable();
        list.dedup();
        list.shrink_to_fit();
        self.failed.try_reserve(1).map_err(|_| Error::new(Status::OutOfMemory, "out of memory"))?;
        self.failed.insert(point, (solid.changes, list));
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failure_is_known_until_what_it_read_changes() {
        let mut solid = Solid::default();
        (solid.changes, solid.changed) = (3, vec![0, 3, 1]);
        let mut memory = Memory::default();
        assert!(!memory.knows(&solid, 7));
        memory.note(&solid, 7, &[1, 2, 2, 5]).unwrap();
        assert!(memory.knows(&solid, 7) && !memory.knows(&solid, 8));
        solid.changes = 4;
        solid.changed[0] = 4;
        assert!(memory.knows(&solid, 7));
        solid.changed[2] = 4;
        assert!(!memory.knows(&solid, 7));
        memory.note(&solid, 7, &[2]).unwrap();
        assert!(memory.knows(&solid, 7));
    }
}
