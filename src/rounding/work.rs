//! The work of finding positions, counted in steps: a search ends when its budget is spent, at the same point on every machine.
use crate::control::Control;
use std::cell::Cell;

/// What a move costs, in tests of one tetrahedron in doubles. 25 and 100 change nothing on the only model measured whose points have to
/// move.
pub const MOVE: u64 = 50;
/// The same for an exact test. 500 and 2,000 change nothing on the only model measured whose points have to move.
pub const EXACT_TET: u64 = 1000;
/// The same for a step of reconnection. 50 and 200 change nothing on the only model measured whose points have to move.
pub const STEP: u64 = 100;

/// The budget of a mesh: at least this much, plus this much per slot.
///
/// The public models need no more than 4,095 in all. Some small random ones take 10⁸ (3 s): more than this budget helps hardly any of
/// these, and all of them get a mesh without points on the surface, which takes less time than the search.
const LEAST: u64 = 1_000_000;
/// The part of it per slot. 100 and 400 change nothing on the only model measured whose points have to move.
const PER_SLOT: u64 = 200;

/// So many count as one step of the control.
const PER_STEP: u64 = 64;

/// A budget, spent by whoever looks for positions. Nothing is left of it once the run is ended; who set it then looks at the control.
pub struct Work<'a> {
    left: Cell<u64>,
    control: &'a Control<'a>,
}

impl<'a> Work<'a> {
    /// The budget for a mesh of so many slots.
    pub fn for_mesh(slots: usize, control: &'a Control<'a>) -> Self {
        Work { left: Cell::new(LEAST + PER_SLOT * slots as u64), control }
    }

    /// Subtracts the cost of a step.
    pub fn spend(&self, count: u64) {
        let before = self.left.get();
        let left = before.saturating_sub(count);
        self.left.set(left);
        let steps = before / PER_STEP - left / PER_STEP;
        if steps > 0 && self.control.steps(steps as u32).is_err() {
            self.left.set(0);
        }
    }

    /// What may end the run.
    pub fn control(&self) -> &'a Control<'a> {
        self.control
    }

    /// Whether nothing is left.
    pub fn is_done(&self) -> bool {
        self.left.get() == 0
    }
}
