//! How good the tetrahedra of all quadruples of a small set of vertices are, computed when first asked for.
use super::signs::{choose4, combination};
use crate::error::Error;

/// Worths by local vertex numbers.
#[derive(Default)]
pub struct Worths {
    /// Per combination, NaN where it is unknown.
    table: Vec<f64>,
}

impl Worths {
    /// Forgets all; `count` vertices come.
    pub fn clear(&mut self, count: usize) -> Result<(), Error> {
        self.table.clear();
        self.table.try_reserve(choose4(count))?;
        self.table.resize(choose4(count), f64::NAN);
        Ok(())
    }

    /// That of a quadruple, which `compute` makes if it is new. Distinct local numbers.
    pub fn of(&mut self, tet: [u8; 4], compute: impl FnOnce() -> f64) -> f64 {
        let worth = &mut self.table[combination(tet).0];
        if worth.is_nan() {
            *worth = compute();
        }
        *worth
    }
}
