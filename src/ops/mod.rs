//! Local operations, one a file: each replaces a few tetrahedra by others with the same boundary, or finds a position for a vertex. Stages
//! are policies over them.
//!
//! Every operation leaves a valid mesh: its tetrahedra are positive by exact signs, subfaces, subsegments and what else must stay are
//! there, and what hangs on the mesh is carried by [`Replace`](crate::kernel::replace::Replace). Floating-point qualities only choose.
pub mod apex;
pub mod approach;
pub mod center;
#[cfg(test)]
pub mod check;
pub mod contract;
pub mod faces;
#[cfg(test)]
mod faces_tests;
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
#[cfg(test)]
pub mod scene_tests;
pub mod shape;
pub mod sheet;
#[cfg(test)]
mod sheet_tests;
pub mod smooth;
#[cfg(test)]
mod vertex_tests;
pub mod widen;
