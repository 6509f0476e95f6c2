//! From the Delaunay tetrahedralization of the vertices to the constrained one.
//!
//! Si & Gärtner 2011: first every segment is made a union of edges by Steiner points on segments (D0 → D1, [`segment`]), then
//! every facet a union of faces without further points (D1 → D2, [`facet`]). All Steiner points are exact; all signs too.
pub mod close;
pub mod facet;
pub mod fill;
pub mod gift_wrap;
pub mod overlap;
pub mod placement;
pub mod segment;
pub mod subface;

use crate::error::{Defect, DefectKind, Element, Error, Status};

/// What to tell the caller when the PLC turns out to cross itself although validation was off.
pub fn crossing(message: &str, first: Element, second: Option<Element>) -> Error {
    let defect = Defect { kind: DefectKind::FacetFacet, first, second, point: None };
    Error::with_defect(Status::SelfIntersection, message, defect)
}

/// An unordered vertex pair as a key.
#[inline]
pub fn edge_key(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// An unordered vertex triple as a key.
#[inline]
pub fn face_key(mut v: [u32; 3]) -> [u32; 3] {
    v.sort_unstable();
    v
}

#[cfg(test)]
mod tests;
