//! Segment recovery: every segment becomes a union of edges, by Steiner points on segments.
//!
//! Si & Gärtner 2011, section 5 (D0 → D1, [`recovery`]). All Steiner points and all signs are exact.
pub mod close;
pub mod placement;
mod present;
pub mod recovery;

use crate::error::{Defect, DefectKind, Element, Error, Status};

/// The error for a PLC that turns out to cross itself when validation was off.
pub fn crossing(message: &'static str, first: Element, second: Option<Element>) -> Error {
    let defect = Defect { kind: DefectKind::FacetFacet, first, second, point: None };
    Error::with_defect(Status::SelfIntersection, message, defect)
}

#[cfg(test)]
mod tests;
