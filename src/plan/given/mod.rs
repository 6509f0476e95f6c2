//! Meshes that are given: from arrays, refined, improved.
//!
//! The arrays are checked by exact signs ([`complex`], [`fans`]), then get regions and kept faces and edges ([`elements`]). To refine or
//! improve a mesh, any of ours, it is checked in the same way and put into the kernel with its subfaces as walls ([`refine`]); points come
//! inside only, by [`fill`](crate::fill), and [`optimise`](crate::optimise) works on the rest.
//!
//! Invariants: subfaces, subsegments and regions stay, with all that is known of them; so do input points, bit for bit, and points of
//! earlier runs on edges or facets. Points inside of earlier runs may move and go.
//!
//! A kept face that is coarser than the sizes wanted there bounds them: the mesh comes down to these sizes within a layer or two.
mod complex;
mod elements;
mod fans;
mod faults;
mod refine;
#[cfg(test)]
mod tests;

use crate::control::{controlled, Control};
use crate::error::{Error, Status};
use crate::options::Options;
use crate::output::{MeshArrays, TetMesh};
use crate::plc::sizes::Sizes;
use crate::progress::{Observer, Phase, Silent};
use complex::Complex;

/// Edge lengths wanted in a mesh that is refined, beside those of the options. The smallest of all counts.
#[allow(clippy::disallowed_methods, reason = "for callers; the library itself never clones it")]
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshSizes {
    /// One length per point of the mesh, and lengths by the markers of subfaces and subsegments and the attributes of regions.
    pub parts: Sizes,
    /// One length per tetrahedron, or empty; infinite where there is no wish.
    pub tets: Vec<f64>,
}

/// Makes a mesh of arrays: reorients tetrahedra, finds neighbours and regions, and keeps the given faces and edges, the boundary, and the
/// faces between different attributes.
///
/// The facet of a subface is the index of the given face; the faces that were not given are numbered after them. The segment of a subsegment
/// is the index of the given edge. A face or edge given twice counts once, with its first marker. Of equal points tetrahedra use the first.
/// At most `max_defects` defects are listed in an error.
///
/// # Errors
/// [`Status::InvalidArgument`]: no tetrahedra, a list of the wrong length, an attribute that is not finite. [`Status::NonFinitePoint`],
/// [`Status::CoordinateRange`]. [`Status::IndexOutOfRange`]: a tetrahedron with a corner that is no point. [`Status::CheckFailed`]: a
/// tetrahedron is flat; a face belongs to more than two, or to two on one side; tetrahedra with a common edge overlap; a given face or edge
/// is none of the mesh. [`Status::TooLarge`], [`Status::OutOfMemory`].
pub fn mesh_from_arrays(arrays: MeshArrays, max_defects: usize) -> Result<TetMesh, Error> {
    controlled(Default::default(), &mut Silent, |control| mesh_from_arrays_with(arrays, max_defects, control))
}

/// The same as a part of a run.
///
/// # Errors
/// As [`mesh_from_arrays`], and what ends the run.
pub fn mesh_from_arrays_with(
    arrays: MeshArrays,
    max_defects: usize,
    control: &Control,
) -> Result<TetMesh, Error> {
    control.progress(Phase::Validate, 0.0)?;
    check_lists(&arrays)?;
    let complex = Complex::new(&arrays.points, &arrays.tets, max_defects, control)?;
    let mesh = elements::assembled(arrays, complex, max_defects, control)?;
    control.progress(Phase::Validate, 1.0)?;
    Ok(mesh)
}

/// Refines a mesh, whoever made it: adds points inside until sizes, volumes and shapes are as wanted, then optimises if the options say
/// so. Of the options those about filling, optimisation and limits count ([`Options::size`] and what follows it).
///
/// Kept are the subfaces and subsegments with facets, segments and markers, the regions, the input points, and points of earlier runs on
/// edges and facets. Points inside of earlier runs come behind them, with the new ones; they may have moved or gone. Surfaces are not
/// refined: sizes near a coarse one are bounded by it. A mesh made with
/// [`Options::drop_unmeshed_points`] is taken as it is: its points count as the input.
///
/// # Errors
/// As [`mesh_from_arrays`] for a mesh that was changed; [`Status::InvalidArgument`] for sizes that nothing can have;
/// [`Status::SteinerLimit`], [`Status::TetrahedraLimit`], [`Status::TooLarge`], and what ends the run.
pub fn refine(
    mesh: &TetMesh,
    sizes: &MeshSizes,
    options: &Options,
    observer: &mut dyn Observer,
) -> Result<TetMesh, Error> {
    controlled(options.limits(), observer, |control| refine_with(mesh, sizes, options, control))
}

/// The same as a part of a run with a control of its own, whose limits count instead of those of `options`.
///
/// # Errors
/// As [`refine`](fn@refine).
pub fn refine_with(
    mesh: &TetMesh,
    sizes: &MeshSizes,
    options: &Options,
    control: &Control,
) -> Result<TetMesh, Error> {
    refine::refined(mesh, sizes, options, control)
}

/// Improves the dihedral angles of a mesh, with an effort of at least 1 ([`Options::optimize`]) or for some seconds
/// ([`Options::optimize_seconds`]). The worst tetrahedron never gets worse. Kept is what [`refine`](fn@refine) keeps.
///
/// # Errors
/// As [`refine`](fn@refine).
pub fn improve(mesh: &TetMesh, options: &Options, observer: &mut dyn Observer) -> Result<TetMesh, Error> {
    controlled(options.limits(), observer, |control| improve_with(mesh, options, control))
}

/// The same as a part of a run with a control of its own, whose limits count instead of those of `options`.
///
/// # Errors
/// As [`refine`](fn@refine).
pub fn improve_with(mesh: &TetMesh, options: &Options, control: &Control) -> Result<TetMesh, Error> {
    let options = Options {
        size: None,
        max_volume: None,
        size_function: None,
        quality: None,
        optimize: options.optimize.max(1),
        ..options.copied()
    };
    refine::refined(mesh, &MeshSizes::default(), &options, control)
}

/// Refuses lists that do not fit, and attributes that are no numbers.
fn check_lists(arrays: &MeshArrays) -> Result<(), Error> {
    let pairs = [
        ("attributes", arrays.attributes.len(), "tetrahedra", arrays.tets.len()),
        ("face markers", arrays.face_markers.len(), "faces", arrays.faces.len()),
        ("edge markers", arrays.edge_markers.len(), "edges", arrays.edges.len()),
    ];
    for (what, given, of, count) in pairs {
        if given != 0 && given != count {
            return Err(Error::new(
                Status::InvalidArgument,
                format_args!("{given} {what} for {count} {of}: one each is needed, or none"),
            ));
        }
    }
    if let Some(t) = arrays.attributes.iter().position(|x| !x.is_finite()) {
        return Err(Error::new(
            Status::InvalidArgument,
            format_args!("the attribute of tetrahedron {t} is NaN or infinite"),
        ));
    }
    if arrays.faces.len().max(arrays.edges.len()) >= u32::MAX as usize / 2 {
        return Err(Error::new(Status::TooLarge, "more faces or edges than can be numbered"));
    }
    Ok(())
}
