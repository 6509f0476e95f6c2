//! Local operations: what replaces a few tetrahedra by others, or finds positions for a point. Stages are policies over them.
pub mod center;
pub mod place;
pub mod polygon;
pub mod quality;
pub mod reconnect;
pub mod shape;
pub mod sheet;
