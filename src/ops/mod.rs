//! Local operations, one a file: each replaces a few tetrahedra by others with the same boundary, or finds a position for a vertex. Stages
//! are policies over them.
//!
//! Every operation leaves a valid mesh: its tetrahedra are positive by exact signs, subfaces, subsegments and what else must stay are
//! there, and what hangs on the mesh is carried by [`Replace`](crate::kernel::replace::Replace). Floating-point qualities only choose.
pub mod approach;
pub mod center;
#[cfg(test)]
pub mod check;
pub mod contract;
pub mod flip;
#[cfg(test)]
mod flip_tests;
pub mod hollow;
pub mod insert;
pub mod place;
pub mod polygon;
pub mod quality;
pub mod reconnect;
pub mod remove_vertex;
pub mod reshape;
pub mod shape;
pub mod sheet;
pub mod smooth;
pub mod widen;
