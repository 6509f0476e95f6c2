//! Reads meshes of other programs and our own, as arrays: TetGen's files, `.vtu`, `.msh`, `.mesh`.
//!
//! A file says what its elements are: tetrahedra, triangles that are faces to be kept, edges to be kept. What is on the boundary or
//! between materials need not be listed. Of elements of second order the corners are read; their other nodes are left out.
use crate::control::Control;
use crate::error::{Element, Error, Status};
use crate::fallible;
use crate::io::surface::no_such_point;
use crate::io::{
    at, bytes_of, output_files, read_medit, read_msh, read_vtu, sniff, tetgen, Format, MeshFiles,
};
use crate::output::MeshArrays;
use crate::INVALID;
use std::path::{Path, PathBuf};

/// What the file of a mesh holds.
#[allow(clippy::disallowed_methods, reason = "for callers; the library itself never clones it")]
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshFile {
    /// The mesh.
    pub arrays: MeshArrays,
    /// The number of attributes per point.
    pub attribute_count: usize,
    /// `attribute_count` numbers per point.
    pub attributes: Vec<f64>,
    /// One marker per point, or empty.
    pub markers: Vec<i32>,
}

/// Reads a mesh from a file: `.ele` (with `.node`, and `.face` and `.edge` if they are there), `.vtu` (with `STEM_subfaces.vtu` if it is
/// there), `.msh`, `.mesh`.
///
/// # Errors
/// As [`read`](crate::io::read).
pub fn read_arrays(path: &Path) -> Result<MeshFile, Error> {
    read_arrays_with(path, &Control::free())
}

/// The same as a part of a run.
///
/// # Errors
/// As [`read_arrays`]; those of [`Control::step`].
pub fn read_arrays_with(path: &Path, control: &Control) -> Result<MeshFile, Error> {
    let format = Format::of(path)?;
    let mut file = match format {
        Format::Ele => read_tetgen(path, control),
        Format::Medit | Format::Msh | Format::Vtu => read_single(path, format, control),
        _ => Err(Error::new(
            Status::Unsupported,
            format_args!(
                "{}: {} is not read as a mesh: meshes are read from .ele, .vtu, .msh and .mesh files",
                path.display(),
                format.noun()
            ),
        )),
    }?;
    if format == Format::Vtu {
        let beside = subfaces_beside(path)?;
        if beside.exists() {
            let faces = read_vtu::read_faces(&bytes_of(&beside, control)?, file.arrays.points.len(), control);
            control.look()?;
            let (faces, markers) = faces.map_err(|e| at(&beside, e))?;
            file.arrays.faces = faces;
            file.arrays.face_markers = markers;
        }
    }
    if file.arrays.tets.is_empty() {
        return Err(at(path, Error::new(Status::Format, "the file holds no tetrahedra")));
    }
    Ok(file)
}

/// The files that [`read_arrays`] reads, those that need not be there included.
///
/// # Errors
/// [`Status::OutOfMemory`]; as [`read_arrays`] for the name.
pub fn array_sources(path: &Path) -> Result<Vec<PathBuf>, Error> {
    Ok(match Format::of(path)? {
        Format::Ele => {
            let MeshFiles { node, ele, face, .. } = MeshFiles::of(path)?;
            fallible::collect([node, ele, face, output_files::with_extension(path, "edge")?])?
        }
        Format::Vtu => fallible::collect([own(path)?, subfaces_beside(path)?])?,
        _ => fallible::collect([own(path)?])?,
    })
}

fn own(path: &Path) -> Result<PathBuf, Error> {
    output_files::copied(path, 0).map_err(|e| output_files::file_error(path, "copy the name", &e))
}

/// Like [`subfaces_path`](crate::io::subfaces_path), with fallible allocation.
fn subfaces_beside(path: &Path) -> Result<PathBuf, Error> {
    output_files::with_suffix(&output_files::with_extension(path, "")?, &["_subfaces.vtu"])
}

fn read_single(path: &Path, format: Format, control: &Control) -> Result<MeshFile, Error> {
    let bytes = bytes_of(path, control)?;
    let outcome = match format {
        _ if bytes.is_empty() => Err(Error::new(Status::Format, "the file is empty")),
        Format::Medit => read_medit::read(&bytes, control),
        Format::Msh => read_msh::read(&bytes, control),
        _ => read_vtu::read(&bytes, control),
    };
    // A reader that was ended sees a file that ends.
    control.look()?;
    outcome.map_err(|error| match error.status {
        Status::Format => at(
            path,
            match sniff::other_kind(&bytes, format).filter(|kind| !is_own(format, kind)) {
                Some(kind) => Error::new(Status::Format, format_args!("not {}: it is {kind}", format.noun())),
                None => error,
            },
        ),
        _ => at(path, error),
    })
}

/// Whether what was recognized is the format itself, or may be.
fn is_own(format: Format, kind: &str) -> bool {
    match format {
        Format::Msh => kind == "a Gmsh mesh",
        Format::Medit => kind == "a MEDIT mesh",
        _ => matches!(kind, "a VTK XML file" | "an XML document" | "binary data"),
    }
}

fn read_tetgen(path: &Path, control: &Control) -> Result<MeshFile, Error> {
    let MeshFiles { node, ele, face, .. } = MeshFiles::of(path)?;
    let edge = output_files::with_extension(path, "edge")?;
    let (node, elements) = (bytes_of(&node, control)?, bytes_of(&ele, control)?);
    let read = tetgen::read_tets(&node, &elements, control);
    control.look()?;
    let tetgen::Tets { nodes, middles, tets, attributes } = read.map_err(|e| at(&ele, e))?;
    drop((node, elements));
    let mut arrays = MeshArrays { tets, attributes, ..MeshArrays::default() };
    if face.exists() {
        let faces = tetgen::read_faces(&bytes_of(&face, control)?, &nodes, middles, control);
        control.look()?;
        for (corners, marker) in faces.map_err(|e| at(&face, e))? {
            fallible::push(&mut arrays.faces, corners)?;
            fallible::push(&mut arrays.face_markers, marker)?;
        }
    }
    if edge.exists() {
        let edges = tetgen::read_edges(&bytes_of(&edge, control)?, &nodes, middles, control);
        control.look()?;
        for (ends, marker) in edges.map_err(|e| at(&edge, e))? {
            fallible::push(&mut arrays.edges, ends)?;
            fallible::push(&mut arrays.edge_markers, marker)?;
        }
    }
    let tetgen::NodeData { points, attribute_count, attributes, markers } = nodes.into_data();
    arrays.points = points;
    Ok(MeshFile { arrays, attribute_count, attributes, markers })
}

/// Takes the elements of a file, one by one.
#[derive(Default)]
pub(super) struct Builder {
    pub file: MeshFile,
    /// Nodes of elements that are no corners.
    others: Vec<u32>,
}

impl Builder {
    /// Adds an element by its nodes, of which the first `corners` count.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn add(&mut self, nodes: &[u32], corners: usize, number: f64) -> Result<(), Error> {
        let arrays = &mut self.file.arrays;
        // Markers are integers, since they come from these formats' integers.
        let marker = number as i32;
        match nodes.get(..corners) {
            Some(&[a, b, c, d]) => {
                fallible::push(&mut arrays.tets, [a, b, c, d])?;
                fallible::push(&mut arrays.attributes, number)?;
            }
            Some(&[a, b, c]) => {
                fallible::push(&mut arrays.faces, [a, b, c])?;
                fallible::push(&mut arrays.face_markers, marker)?;
            }
            Some(&[a, b]) => {
                fallible::push(&mut arrays.edges, [a, b])?;
                fallible::push(&mut arrays.edge_markers, marker)?;
            }
            _ => {}
        }
        fallible::extend(&mut self.others, nodes.iter().skip(corners).copied())?;
        Ok(())
    }

    /// The error for a node that does not exist, at a line.
    pub fn no_such_node(&self, line: usize, corners: usize, node: i64) -> Error {
        let arrays = &self.file.arrays;
        let element = match corners {
            4 => Element::Tet(arrays.tets.len() as u32),
            3 => Element::Facet(arrays.faces.len() as u32),
            _ => Element::Segment(arrays.edges.len() as u32),
        };
        no_such_point(element, format_args!("line {line}: there is no node {node}"))
    }

    /// The mesh, without the nodes that are no corners.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn finish(self) -> Result<MeshFile, Error> {
        let Builder { mut file, others } = self;
        if others.is_empty() {
            return Ok(file);
        }
        let arrays = &mut file.arrays;
        let mut keep = fallible::filled(true, arrays.points.len())?;
        others.iter().for_each(|&v| keep[v as usize] = false);
        let corners = arrays.tets.iter().flatten().chain(arrays.faces.iter().flatten());
        corners.chain(arrays.edges.iter().flatten()).for_each(|&v| keep[v as usize] = true);
        let mut number = fallible::filled(INVALID, keep.len())?;
        let kept = number.iter_mut().zip(&keep).filter(|x| *x.1);
        kept.zip(0..).for_each(|((number, _), new)| *number = new);
        let mut left = keep.iter();
        arrays.points.retain(|_| left.next().copied().unwrap_or(true));
        let mut left = keep.iter();
        file.markers.retain(|_| left.next().copied().unwrap_or(true));
        let width = file.attribute_count.max(1);
        let mut at = 0;
        file.attributes.retain(|_| {
            at += 1;
            keep.get((at - 1) / width).copied().unwrap_or(true)
        });
        let renumber = |v: &mut u32| *v = number[*v as usize];
        arrays.tets.iter_mut().flatten().for_each(renumber);
        arrays.faces.iter_mut().flatten().for_each(renumber);
        arrays.edges.iter_mut().flatten().for_each(renumber);
        Ok(file)
    }
}
