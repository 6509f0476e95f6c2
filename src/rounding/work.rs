//! How much is done to find positions, counted in steps: a search ends when its share is spent, on every machine at the same place.
use std::cell::Cell;

/// What other steps cost, in tests of one tetrahedron in doubles.
pub const MOVE: u64 = 50;
pub const EXACT_TET: u64 = 1000;
pub const STEP: u64 = 100;

/// What a mesh is worth: this much at least, and this much more per slot.
///
/// The public models need no more than 4,095 in all. Of random small ones some take 10⁸ (3 s): hardly any of these is mended by more than
/// this, and all by a mesh without points on the surface, which takes less than the search.
const LEAST: u64 = 1_000_000;
const PER_SLOT: u64 = 200;

/// A budget, spent by whoever looks for positions.
#[derive(Debug)]
pub struct Work {
    left: Cell<u64>,
}

impl Work {
    /// The budget for a mesh of so many slots.
    pub fn for_mesh(slots: usize) -> Self {
        Work { left: Cell::new(LEAST + PER_SLOT * slots as u64) }
    }

    /// Takes off what a step costs.
    pub fn spend(&self, count: u64) {
        self.left.set(self.left.get().saturating_sub(count));
    }

    /// Nothing is left.
    pub fn is_done(&self) -> bool {
        self.left.get() == 0
    }
}
