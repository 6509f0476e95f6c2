//! A set of tetrahedra that a search has met: scratch space that belongs to the searcher, so that searches only read the mesh.
//!
//! Open addressing with linear probing, at most half full; an entry counts if it has the stamp of the current search, so clearing takes no
//! time. Its size follows the largest search, not the mesh.
use crate::error::Error;
use crate::fallible;

/// Entries at the start: enough for the star of most vertices. From 32 to 128 the time of a model with 2,870 Steiner points stays within
/// 1 %: nothing measurable depends on it.
const FIRST: usize = 64;

/// The set; empty until [`Visited::begin`].
#[derive(Debug, Default)]
pub struct Visited {
    /// Tetrahedron and stamp.
    entries: Vec<(u32, u32)>,
    stamp: u32,
    count: usize,
}

impl Visited {
    /// Forgets all.
    pub fn begin(&mut self) {
        self.count = 0;
        self.stamp = self.stamp.wrapping_add(1);
        if self.stamp == 0 {
            self.entries.fill((0, 0));
            self.stamp = 1;
        }
    }

    /// The index of the entry of `t`, or of the free one where it belongs.
    #[inline(always)]
    fn place(&self, t: u32) -> usize {
        let mask = self.entries.len() - 1;
        // Fibonacci hashing (Knuth, volume 3, section 6.4).
        let mut place = (t.wrapping_mul(0x9e37_79b9) >> 8) as usize & mask;
        loop {
            let (key, stamp) = self.entries[place];
            if stamp != self.stamp || key == t {
                return place;
            }
            place = (place + 1) & mask;
        }
    }

    /// Whether `t` is in the set.
    #[inline(always)]
    pub fn contains(&self, t: u32) -> bool {
        self.count > 0 && self.entries[self.place(t)] == (t, self.stamp)
    }

    /// Adds `t`; true if it was not in the set.
    #[inline(always)]
    pub fn insert(&mut self, t: u32) -> Result<bool, Error> {
        if 2 * self.count >= self.entries.len() {
            self.grow()?;
        }
        let place = self.place(t);
        if self.entries[place] == (t, self.stamp) {
            return Ok(false);
        }
        self.entries[place] = (t, self.stamp);
        self.count += 1;
        Ok(true)
    }

    #[cold]
    #[inline(never)]
    fn grow(&mut self) -> Result<(), Error> {
        let larger = fallible::filled((0, 0), (2 * self.entries.len()).max(FIRST))?;
        let old = std::mem::replace(&mut self.entries, larger);
        self.stamp = self.stamp.max(1);
        for (t, _) in old.into_iter().filter(|entry| entry.1 == self.stamp) {
            let place = self.place(t);
            self.entries[place] = (t, self.stamp);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn it_is_a_set_that_forgets() {
        let mut visited = Visited::default();
        let mut state = 1u32;
        for round in 0..200 {
            visited.begin();
            let mut expected = HashSet::new();
            for _ in 0..round * 3 {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                let t = state >> 24 << (state % 9);
                assert_eq!(visited.contains(t), expected.contains(&t));
                assert_eq!(visited.insert(t).unwrap(), expected.insert(t));
                assert!(visited.contains(t));
            }
        }
    }

    #[test]
    fn stamps_may_return() {
        let mut visited = Visited::default();
        visited.begin();
        assert!(visited.insert(5).unwrap());
        visited.stamp = u32::MAX;
        visited.begin();
        assert!(!visited.contains(5) && visited.insert(5).unwrap());
    }
}
