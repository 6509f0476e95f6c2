//! The exact checker: does a mesh have the guaranteed properties for its input?
//!
//! It is independent of how the mesh was built: it reads only the input and the output, and evaluates exact signs without the engine. In
//! order:
//!
//! 1. array shapes, index ranges, finite coordinates (if this fails, nothing else is checked);
//! 2. points: those of the input first, bit for bit; none lost;
//! 3. orientation: every tetrahedron strictly positive;
//! 4. topology: faces shared by at most two tetrahedra, on opposite sides; neighbours; regions;
//! 5. conformity: segments are chains of edges, facets are tiled exactly by their subfaces, the boundary lies on facets;
//! 6. on request: every face that is no subface is locally Delaunay;
//! 7. on request: the surface, or its outer boundary, is the input's, triangle by triangle, without any added point on it.
//!
//! It follows that the boundary of the mesh is that of the input. It does not follow that no two layers of tetrahedra without a common
//! vertex cover the same space.
//!
//! For a mesh made in mode Delaunay ([`Guarantee::Delaunay`]) facets and segments are not checked, unless it is to keep the surface. For a
//! weighted one ([`Guarantee::WeightedDelaunay`]) the power test decides what is locally Delaunay; a point that is no vertex must be hidden by
//! the tetrahedron that contains it. If the weights are not known, as in a mesh from files, neither is judged.
//! A mesh of another mode that lists no subfaces covers no facet: if the input has any, that is a defect.
//!
//! In a mesh read from files the parents of Steiner points and subfaces may be unknown. Then only doubles are checked: topology,
//! orientation, points; segments if there are no Steiner points. Faces with such points that are not locally Delaunay are only counted
//! (rounding may cause that), and whether the facets are covered is not judged.
mod arrays;
mod audit;
mod boundary;
mod carved;
mod chains;
mod context;
mod coverage;
mod delaunay;
mod faces;
mod facets;
mod geometry;
mod orientation;
mod overlaps;
mod points;
mod preserved;
mod promise;
mod report;
mod segments;
mod subfaces;
#[cfg(test)]
mod tests;
mod topology;

pub use audit::audit;
pub use promise::{audit_promise, Promise};

use crate::error::Error;
use crate::fallible;
use crate::options::Preserve;
use crate::output::{Guarantee, TetMesh};
use crate::plc::Plc;
use context::Context;
use report::Report;
use std::borrow::Cow;

/// Checks `mesh` against the input it was made from; `constrained_delaunay` requires the Delaunay property too.
///
/// # Errors
/// [`Status::CheckFailed`](crate::Status::CheckFailed) with all defects, of which at most `max_defects` are listed;
/// [`Status::CoordinateRange`](crate::Status::CoordinateRange) if exact arithmetic cannot represent the coordinates;
/// [`Status::OutOfMemory`](crate::Status::OutOfMemory).
pub fn check_mesh(
    plc: &Plc,
    mesh: &TetMesh,
    constrained_delaunay: bool,
    max_defects: usize,
) -> Result<(), Error> {
    check(plc, mesh, Wish { constrained_delaunay, preserved: None }, max_defects)
}

/// Checks `mesh` like [`check_mesh`], without the Delaunay property, and that it keeps the surface as
/// [`Mode::Preserve`](crate::Mode::Preserve) promises: every input triangle is a face (or, if input points lie on it, a union of faces with
/// these as corners), every polygon is a union of faces and every segment one of edges between input points, and no added point lies on a
/// facet or segment.
///
/// # Errors
/// As [`check_mesh`].
pub fn check_preserved(plc: &Plc, mesh: &TetMesh, max_defects: usize) -> Result<(), Error> {
    check(plc, mesh, Wish { constrained_delaunay: false, preserved: Some(Preserve::All) }, max_defects)
}

/// Checks `mesh` like [`check_mesh`], without the Delaunay property, and that it keeps the outer boundary as
/// [`Preserve::Outer`] promises: where the mesh is on only one side of a facet, input triangles are faces (or, if input points lie on them,
/// unions of faces with these as corners), without any added point.
///
/// # Errors
/// As [`check_mesh`].
pub fn check_preserved_outer(plc: &Plc, mesh: &TetMesh, max_defects: usize) -> Result<(), Error> {
    check(plc, mesh, Wish { constrained_delaunay: false, preserved: Some(Preserve::Outer) }, max_defects)
}

/// Checks `mesh` for the guarantee of the mode in which it was made ([`TetMesh::guarantee`]), like [`check_mesh`] with the Delaunay
/// property, [`check_preserved`] or [`check_preserved_outer`].
///
/// # Errors
/// As [`check_mesh`].
pub fn check_guarantee(plc: &Plc, mesh: &TetMesh, max_defects: usize) -> Result<(), Error> {
    match mesh.guarantee {
        Guarantee::ConstrainedDelaunay | Guarantee::Delaunay | Guarantee::WeightedDelaunay => {
            check_mesh(plc, mesh, true, max_defects)
        }
        Guarantee::Conforming | Guarantee::Given => check_mesh(plc, mesh, false, max_defects),
        Guarantee::Preserved => check_preserved(plc, mesh, max_defects),
        Guarantee::PreservedOuter => check_preserved_outer(plc, mesh, max_defects),
    }
}

/// The properties required beyond validity.
struct Wish {
    constrained_delaunay: bool,
    preserved: Option<Preserve>,
}

fn check(plc: &Plc, mesh: &TetMesh, wish: Wish, max_defects: usize) -> Result<(), Error> {
    // The check compares by the input's own indices.
    let whole = match &mesh.dropped {
        Some(_) => Cow::Owned(mesh.with_dropped(&plc.points)?),
        None => Cow::Borrowed(mesh),
    };
    let mesh = &*whole;
    let mut report = Report::new(max_defects);
    arrays::check_arrays(plc, mesh, &mut report);
    let mut points_only = Plc::default();
    let plc = match mesh.guarantee {
        Guarantee::Delaunay | Guarantee::WeightedDelaunay if wish.preserved.is_none() => {
            points_only.points.try_reserve_exact(plc.points.len())?;
            fallible::append(&mut points_only.points, &plc.points)?;
            if mesh.guarantee == Guarantee::WeightedDelaunay && plc.lift.values().len() == plc.points.len() {
                points_only.lift = plc.lift.try_clone()?;
            }
            &points_only
        }
        _ => plc,
    };
    if report.count() > 0 {
        return report.finish();
    }
    let context = Context::new(plc, mesh)?;
    points::check_points(&context, &mut report)?;
    orientation::check_orientation(&context, &mut report);
    let adjacency = topology::check_topology(&context, &mut report)?;
    let subfaces = subfaces::check_subfaces(&context, &mut report)?;
    topology::check_regions(&context, &adjacency, &subfaces, &mut report);
    check_conformity(&context, &mut report)?;
    boundary::check_boundary(&context, &adjacency, &subfaces, &mut report);
    match wish.preserved {
        Some(Preserve::All) => preserved::check_preserved(&context, &mut report)?,
        Some(Preserve::Outer) => preserved::check_outer(&context, &mut report)?,
        None => {}
    }
    if wish.constrained_delaunay {
        delaunay::check_delaunay(&context, &adjacency, &subfaces, &mut report);
    }
    report.finish()
}

/// Checks segments and facets, as far as the mesh says where its points and faces come from.
fn check_conformity(context: &Context, report: &mut Report) -> Result<(), Error> {
    if !context.parents_known {
        report.note(format_args!(
            "the mesh does not say where its added points lie: conformity was not judged"
        ));
        return Ok(());
    }
    let chains = chains::Chains::new(context)?;
    segments::check_segments(context, &chains, report)?;
    if !context.subfaces_known() {
        report.note(format_args!(
            "the mesh does not say on which facets its faces lie: coverage was not judged"
        ));
        return Ok(());
    }
    let facets = facets::facets(context, report)?;
    coverage::check_inner_edges(context, &facets, &chains, report)?;
    let pieces = facets::pieces(context, &facets, &chains)?;
    let group = facets::groups(context, &facets, &pieces)?;
    coverage::check_coverage(context, &facets, &pieces, &group, report)
}
