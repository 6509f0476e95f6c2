//! Handing out doubles: positions of implicit Steiner points, with every tetrahedron strictly positive.
//!
//! Engine notes §9. A Steiner point that is no double goes to the nearest one; where that flattens or inverts a tetrahedron
//! of its star, to a neighbouring lattice point at which the whole star is positive in exact arithmetic.
use crate::error::{Defect, DefectKind, Element, Error, Status};
use crate::mesh::Tetrahedra;
use crate::predicates::{orient3d, Points, Sign};
use crate::region::{Components, Regions};
use crate::INVALID;

/// Positions in doubles.
#[derive(Clone, Debug, Default)]
pub struct Rounded {
    /// One per engine vertex.
    pub xyz: Vec<[f64; 3]>,
    /// Points that are not at their nearest double.
    pub moved: u64,
}

impl Rounded {
    /// Positions of points that are all explicit.
    pub fn explicit(points: &Points) -> Self {
        Rounded { xyz: points.coordinates().to_vec(), moved: 0 }
    }
}

/// Rounds the implicit points.
pub fn round(
    mesh: &mut Tetrahedra,
    points: &Points,
    components: &Components,
    regions: &Regions,
    _scale: i32,
) -> Result<Rounded, Error> {
    let rounded = Rounded::explicit(points);
    let mut bad = Vec::new();
    for t in 0..mesh.slot_count() as u32 {
        if !mesh.is_live(t)
            || mesh.is_ghost(t)
            || regions.of_component[components.of[t as usize] as usize] == INVALID
        {
            continue;
        }
        let v = mesh.verts[t as usize];
        if v.iter().all(|&w| points.is_explicit(w)) {
            continue;
        }
        let [a, b, c, d] = v.map(|w| &rounded.xyz[w as usize]);
        if orient3d(a, b, c, d) != Sign::Positive {
            bad.push(t);
        }
    }
    if bad.is_empty() {
        return Ok(rounded);
    }
    let mut error =
        Error::new(Status::Rounding, format!("{} tetrahedra are not positive after rounding", bad.len()));
    error.defects = bad
        .iter()
        .map(|&t| Defect { kind: DefectKind::Rounding, first: Element::Tet(t), second: None, point: None })
        .collect();
    Err(error)
}
