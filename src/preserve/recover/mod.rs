//! Recovery of the surface by reconnecting tetrahedra: [`edges`] by flips and searches, then [`faces`].
pub mod breakpoint;
pub mod corridor;
pub mod edges;
pub mod faces;
pub mod order;
