//! The qualities of the tetrahedra of all quadruples of a small set of vertices, computed on demand.
use crate::error::Error;
use crate::fallible;
use crate::ops::reconnect::signs::{choose4, combination};

/// Qualities by local vertex numbers.
#[derive(Default)]
pub struct Qualities {
    /// For each combination its quality, or NaN if unknown.
    table: Vec<f64>,
}

impl Qualities {
    /// Forgets all qualities and makes room for `count` vertices.
    pub fn clear(&mut self, count: usize) -> Result<(), Error> {
        self.table.clear();
        fallible::resize(&mut self.table, choose4(count), f64::NAN)?;
        Ok(())
    }

    /// The quality of a quadruple of distinct local numbers, computed by `compute` if it is unknown.
    pub fn of(&mut self, tet: [u8; 4], compute: impl FnOnce() -> f64) -> f64 {
        let quality = &mut self.table[combination(tet).0];
        if quality.is_nan() {
            *quality = compute();
        }
        *quality
    }
}
