//! Skinny tetrahedra: those above a radius-edge ratio, and what of the input makes them so.
//!
//! Refinement reaches its ratio but where the input is in the way (Shewchuk 1998; Si 2008). Causes, of which the first one counts:
//!
//! 1. *Wedge*: the tetrahedron is in a narrow wedge between two facets ([`forced`](super::forced)).
//! 2. *Corner*: a face of it is in a [corner](super::corners) of a facet that is too narrow for the ratio: every mesh of the input has
//!    tetrahedra above it there.
//! 3. *Face*: a face of it is a triangle of a kept surface, and above the ratio itself: the circumradius of a tetrahedron is not smaller, its
//!    shortest edge not longer.
//! 4. *Beside*: it has a point in common with a tetrahedron of the first three kinds, which are input-forced, whatever the ratio of that one.
//! 5. *Other*: none of these. Refinement leaves such tetrahedra at angles of the input below 90° that force nothing, between features that are
//!    close to each other for their size, and where the points for shapes are used up; optimisation, whose measure is the dihedral angle,
//!    makes some.
use crate::error::{Error, Status};
use crate::fallible;
use crate::options::Options;
use crate::output::Guarantee;
use crate::query::faces::side_with;
use crate::query::quality::corners::{narrow_corners, Triangle};
use crate::query::quality::{ForcedTet, TetQuality};
use crate::{TetMesh, INVALID};

/// Why a tetrahedron is above a radius-edge ratio. The first three are input-forced.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u32)]
pub enum SkinnyCause {
    /// It is in a narrow wedge between two facets ([`ForcedTet`]).
    Wedge,
    /// It is at a corner of a facet that is too narrow for the ratio.
    Corner,
    /// It is at a triangle of a kept surface that is above the ratio itself.
    Face,
    /// It has a point in common with an input-forced tetrahedron.
    Beside,
    /// None of these.
    Other,
}

impl SkinnyCause {
    /// All causes, in the order of their numbers.
    pub const ALL: [SkinnyCause; 5] =
        [SkinnyCause::Wedge, SkinnyCause::Corner, SkinnyCause::Face, SkinnyCause::Beside, SkinnyCause::Other];

    /// A name in one word.
    pub fn name(self) -> &'static str {
        match self {
            SkinnyCause::Wedge => "wedge",
            SkinnyCause::Corner => "corner",
            SkinnyCause::Face => "face",
            SkinnyCause::Beside => "beside",
            SkinnyCause::Other => "other",
        }
    }

    /// Whether the tetrahedron is input-forced.
    pub fn is_forced(self) -> bool {
        self <= SkinnyCause::Face
    }
}

/// A tetrahedron above a radius-edge ratio.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct SkinnyTet {
    /// The tetrahedron.
    pub tet: u32,
    /// Why it is one.
    pub cause: SkinnyCause,
    /// The input facets that force it, the smaller index first; twice the same if it is one. With [`SkinnyCause::Beside`] those that force
    /// what it is beside, with [`SkinnyCause::Other`] both are [`INVALID`].
    pub facets: [u32; 2],
    /// Its circumradius over its shortest edge.
    pub radius_edge: f64,
}

/// The tetrahedra above a radius-edge ratio.
#[derive(Debug, Default, PartialEq)]
pub struct SkinnyTets {
    /// The ratio.
    pub ratio: f64,
    /// All tetrahedra above it, in ascending order.
    pub list: Vec<SkinnyTet>,
}

impl SkinnyTets {
    /// How many there are of a cause.
    pub fn count(&self, cause: SkinnyCause) -> usize {
        self.list.iter().filter(|skinny| skinny.cause == cause).count()
    }
}

/// What forces a tetrahedron.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Reason {
    tet: u32,
    cause: SkinnyCause,
    facets: [u32; 2],
}

/// The tetrahedra above a radius-edge ratio, by default the one that was asked for ([`TetMesh::ratio`]), or 2 if none was. `forced`: the
/// mesh's input-forced tetrahedra, as [`forced_tets`](super::forced_tets) lists them.
///
/// # Errors
/// [`Status::InvalidArgument`] if the ratio is not positive and finite, [`Status::OutOfMemory`].
pub fn skinny_tets(mesh: &TetMesh, ratio: Option<f64>, forced: &[ForcedTet]) -> Result<SkinnyTets, Error> {
    let ratio = ratio.or(mesh.ratio).unwrap_or(Options::USUAL_RATIO);
    if !(ratio > 0.0 && ratio.is_finite()) {
        return Err(Error::new(
            Status::InvalidArgument,
            format_args!("ratio: {ratio} is no positive finite number"),
        ));
    }
    let reasons = reasons(mesh, ratio, forced)?;
    let beside = beside(mesh, &reasons)?;
    let mut next = reasons.iter().peekable();
    let mut list = Vec::new();
    for (tet, corners) in (0..).zip(&mesh.tets) {
        let reason = next.next_if(|reason| reason.tet == tet);
        let radius_edge = TetQuality::of_tet(mesh, corners).radius_edge;
        if radius_edge > ratio {
            let near = || corners.iter().find_map(|&v| beside.get(v as usize).filter(|x| x[0] != INVALID));
            let (cause, facets) = match (reason, near()) {
                (Some(reason), _) => (reason.cause, reason.facets),
                (None, Some(&facets)) => (SkinnyCause::Beside, facets),
                (None, None) => (SkinnyCause::Other, [INVALID; 2]),
            };
            fallible::push(&mut list, SkinnyTet { tet, cause, facets, radius_edge })?;
        }
    }
    Ok(SkinnyTets { ratio, list })
}

/// The input-forced tetrahedra, in ascending order.
fn reasons(mesh: &TetMesh, ratio: f64, forced: &[ForcedTet]) -> Result<Vec<Reason>, Error> {
    let of_wedge =
        |forced: &ForcedTet| Reason { tet: forced.tet, cause: SkinnyCause::Wedge, facets: forced.facets };
    let mut reasons = fallible::collect(forced.iter().map(of_wedge))?;
    let mut add = |subface: usize, cause: SkinnyCause, facets: [u32; 2]| {
        let Some(face) = mesh.subfaces.get(subface) else { return Ok(()) };
        for tet in face.tets.into_iter().filter(|&tet| side_with(mesh, tet, &face.corners).is_some()) {
            fallible::push(&mut reasons, Reason { tet, cause, facets })?;
        }
        Ok(())
    };
    narrow_corners(mesh, ratio, |subface, facets| add(subface, SkinnyCause::Corner, facets))?;
    for (i, face) in mesh.subfaces.iter().enumerate() {
        let kept = match mesh.guarantee {
            Guarantee::Preserved | Guarantee::Given => true,
            Guarantee::PreservedOuter => face.tets[1] == INVALID,
            Guarantee::ConstrainedDelaunay
            | Guarantee::Conforming
            | Guarantee::Delaunay
            | Guarantee::WeightedDelaunay => false,
        };
        if kept && Triangle::of(mesh, &face.corners).is_none_or(|triangle| triangle.radius_edge() > ratio) {
            add(i, SkinnyCause::Face, [face.facet; 2])?;
        }
    }
    reasons.sort_unstable();
    reasons.dedup_by_key(|reason| reason.tet);
    Ok(reasons)
}

/// By point, the facets that force a tetrahedron there, or none; of several tetrahedra the first one.
fn beside(mesh: &TetMesh, reasons: &[Reason]) -> Result<Vec<[u32; 2]>, Error> {
    let count = if reasons.is_empty() { 0 } else { mesh.points.len() };
    let mut beside = fallible::filled([INVALID; 2], count)?;
    for reason in reasons.iter().rev() {
        for &corner in mesh.tets.get(reason.tet as usize).into_iter().flatten() {
            if let Some(facets) = beside.get_mut(corner as usize) {
                *facets = reason.facets;
            }
        }
    }
    Ok(beside)
}

#[cfg(test)]
#[path = "skinny_tests.rs"]
mod tests;
