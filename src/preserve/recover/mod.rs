//! Recovery of the surface by reconnecting tetrahedra: [`edges`] by flips and searches, then [`faces`].
pub mod breakpoint;
pub mod corridor;
pub mod edges;
pub mod faces;
pub mod flips;
#[cfg(test)]
mod flips_tests;
pub mod order;
