//! Release of the surface from its Steiner points: those on [`segments`] go, [`patches`] get the surface's triangles again, and unneeded
//! points [`inside`] are removed.
pub mod facets;
pub mod inside;
pub mod patches;
pub mod relocate;
pub mod schedule;
pub mod segments;
