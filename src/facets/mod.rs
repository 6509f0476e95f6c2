//! Facet recovery: every facet becomes a union of faces, without further points.
//!
//! Si & Gärtner 2011, section 6 (D1 → D2, [`recovery`]). Facets of more than three corners take the triangulation that the mesh has
//! ([`polygons`]).
pub mod cavity;
pub mod fill;
pub mod gift_wrap;
pub mod overlap;
pub mod polygons;
pub mod recovery;
pub mod subface;

#[cfg(test)]
mod tests;
