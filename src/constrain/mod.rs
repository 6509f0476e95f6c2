//! From the Delaunay tetrahedralization of the vertices to the constrained one.
//!
//! Si & Gärtner 2011: first every segment is made a union of edges by Steiner points on segments (D0 → D1, [`segment`]), then
//! every facet a union of faces without further points (D1 → D2, [`facet`]). All Steiner points and all signs are exact.
pub mod cavity;
pub mod close;
pub mod facet;
pub mod fill;
pub mod gift_wrap;
pub mod overlap;
pub mod placement;
pub mod polygons;
mod present;
pub mod segment;
pub mod subface;

pub use crate::mesh::{edge_key, face_key};

use crate::error::{Defect, DefectKind, Element, Error, Status};

/// The error for a PLC that turns out to cross itself when validation was off.
pub fn crossing(message: &'static str, first: Element, second: Option<Element>) -> Error {
    let defect = Defect { kind: DefectKind::FacetFacet, first, second, point: None };
    Error::with_defect(Status::SelfIntersection, message, defect)
}

#[cfg(test)]
mod tests;
