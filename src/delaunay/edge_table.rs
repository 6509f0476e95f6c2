//! Half-edges of a cavity's boundary by their ends, for cavities whose vertices do not fit a square table.
//!
//! Open addressing with linear probing, at most half full. Only looked up by key, so the internal order does not matter.

use crate::error::Error;
use crate::fallible;

/// Corner codes of directed edges.
#[derive(Default)]
pub(super) struct EdgeTable {
    /// Edge and code; the edge from the ghost to itself marks free entries.
    entries: Vec<(u64, u32)>,
    /// The hash is the leading bits of the product: the number of bits dropped.
    shift: u32,
}

const FREE: u64 = u64::MAX;

fn key(a: u32, b: u32) -> u64 {
    u64::from(a) << 32 | u64::from(b)
}

impl EdgeTable {
    /// Empties the table and makes room for `count` edges.
    pub(super) fn clear(&mut self, count: usize) -> Result<(), Error> {
        let places = (2 * count).next_power_of_two().max(2);
        self.entries.clear();
        fallible::resize(&mut self.entries, places, (FREE, 0))?;
        self.shift = u64::BITS - places.ilog2();
        Ok(())
    }

    /// The index of the edge, or of the free entry where it belongs.
    fn place(&self, key: u64) -> usize {
        // Fibonacci hashing (Knuth, volume 3, section 6.4): multiples of the golden ratio spread evenly.
        let mut place = ((key ^ key >> 32).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> self.shift) as usize;
        while self.entries[place].0 != key && self.entries[place].0 != FREE {
            place = (place + 1) % self.entries.len();
        }
        place
    }

    /// Inserts the edge from `a` to `b`, which must not yet be in the table.
    pub(super) fn insert(&mut self, a: u32, b: u32, code: u32) {
        let key = key(a, b);
        let place = self.place(key);
        self.entries[place] = (key, code);
    }

    /// The code of the edge from `a` to `b`.
    pub(super) fn get(&self, a: u32, b: u32) -> Option<u32> {
        let (found, code) = self.entries[self.place(key(a, b))];
        (found != FREE).then_some(code)
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        16 * self.entries.capacity()
    }
}
