//! Files: reads surfaces and meshes, writes both. The extension of a file determines its format; see [`Format`].
//!
//! Invariants: a malformed file gives an error that names the line, never a panic and never an allocation beyond what its
//! size justifies; coordinates are read correctly rounded and written in the fewest digits that read back bit for bit;
//! output appears complete under its name or not at all.
//!
//! Points keep their order. OFF and TetGen's formats keep equal points as they are (the engine maps them); STL, OBJ and PLY
//! are read with equal points joined, since these formats (or most writers of them) repeat a point per triangle or patch.
use crate::control::Control;
use crate::error::{Error, Status};
use crate::fallible;
use crate::output::{Subface, TetMesh};
use crate::plc::Plc;
use crate::warning::Warnings;
use crate::INVALID;
use rustc_hash::FxHashMap;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

mod groups;
mod inp;
mod medit;
mod mesh_file;
mod model;
mod msh;
mod obj;
mod off;
mod output_files;
mod parents;
mod ply;
mod quality;
mod read_medit;
mod read_msh;
mod read_vtu;
mod sniff;
mod stl;
mod surface;
mod tags;
#[cfg(test)]
mod tests;
mod tetgen;
mod text;
mod vtk;
mod vtu;
mod write_mesh;
mod write_surface;
mod write_tetgen;
mod write_voronoi;

pub use crate::options::{MshVersion, RegionName, WriteOptions};
pub use mesh_file::{array_sources, read_arrays, read_arrays_with, MeshFile};
pub use write_mesh::{subfaces_path, write, write_with, UnusedOption};
pub use write_voronoi::write_voronoi;

/// A file format, known by its extension.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// Geomview's Object File Format (surface).
    Off,
    /// STL, text or binary (surface; written in binary).
    Stl,
    /// Wavefront OBJ (surface).
    Obj,
    /// PLY, text or binary (surface; written in binary, little endian).
    Ply,
    /// TetGen's `.poly` (PLC).
    Poly,
    /// TetGen's `.smesh` (PLC).
    Smesh,
    /// TetGen's `.node` (points).
    Node,
    /// TetGen's `.ele` with `.node`, `.face`, `.edge`, `.neigh` beside it, and our own `.parents` (mesh).
    Ele,
    /// VTK XML unstructured grid (mesh).
    Vtu,
    /// Legacy VTK (mesh).
    Vtk,
    /// Gmsh MSH 4.1 or 2.2 (mesh).
    Msh,
    /// Abaqus and CalculiX input decks (mesh).
    Inp,
    /// MEDIT / INRIA `.mesh` (mesh).
    Medit,
}

/// The extensions, for messages.
const KNOWN: &str =
    "surfaces: .off .stl .obj .ply .poly .smesh .node; meshes: .vtu .vtk .msh .inp .mesh .ele";

impl Format {
    /// The format of a path by its extension (upper or lower case).
    ///
    /// # Errors
    /// [`Status::Unsupported`] for an extension that is none of ours.
    pub fn of(path: &Path) -> Result<Format, Error> {
        let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
        Ok(match lowercase(extension, &mut [0; 8]) {
            "off" => Format::Off,
            "stl" => Format::Stl,
            "obj" => Format::Obj,
            "ply" => Format::Ply,
            "poly" => Format::Poly,
            "smesh" => Format::Smesh,
            "node" => Format::Node,
            "ele" => Format::Ele,
            "vtu" => Format::Vtu,
            "vtk" => Format::Vtk,
            "msh" => Format::Msh,
            "inp" => Format::Inp,
            "mesh" => Format::Medit,
            "" => {
                return Err(Error::new(
                    Status::Unsupported,
                    format_args!(
                        "{}: unknown file format: the name has no extension ({KNOWN})",
                        path.display()
                    ),
                ));
            }
            _ => {
                return Err(Error::new(
                    Status::Unsupported,
                    format_args!("{}: unknown file format '.{extension}' ({KNOWN})", path.display()),
                ));
            }
        })
    }

    /// What a file of it is called in messages.
    fn noun(self) -> &'static str {
        match self {
            Format::Off => "an OFF file",
            Format::Stl => "an STL file",
            Format::Obj => "an OBJ file",
            Format::Ply => "a PLY file",
            Format::Poly => "a .poly file",
            Format::Smesh => "a .smesh file",
            Format::Node => "a .node file",
            Format::Ele => "an .ele file",
            Format::Vtu => "a .vtu file",
            Format::Vtk => "a .vtk file",
            Format::Msh => "an .msh file",
            Format::Inp => "an .inp file",
            Format::Medit => "a .mesh file",
        }
    }

    /// [`read`] reads it.
    pub fn is_surface(self) -> bool {
        use Format::*;
        matches!(self, Off | Stl | Obj | Ply | Poly | Smesh | Node)
    }

    /// [`write()`] writes it.
    pub fn is_mesh(self) -> bool {
        !self.is_surface()
    }
}

/// Reads a PLC from a file. A `.poly` or `.smesh` without points takes them from the `.node` beside it.
///
/// # Errors
/// [`Status::File`]: it cannot be read. [`Status::Format`]: the content is malformed; the message names file and line.
/// [`Status::IndexOutOfRange`]: an element refers to a point that does not exist. [`Status::Unsupported`]: a format that is
/// no surface format, or a variant that is not read. [`Status::TooLarge`], [`Status::OutOfMemory`].
pub fn read(path: &Path) -> Result<Plc, Error> {
    read_with(path, &Control::free())
}

/// The same as a part of a run.
///
/// # Errors
/// As [`read`]; those of [`Control::step`].
pub fn read_with(path: &Path, control: &Control) -> Result<Plc, Error> {
    let format = Format::of(path)?;
    let bytes = bytes_of(path, control)?;
    parse(&bytes, format, || bytes_of(&output_files::with_extension(path, "node")?, control), control)
        .map_err(|e| at(path, e))
}

/// The files that [`read`] reads: `path`, and the `.node` file beside it where that has the points. Of what cannot be read twice the
/// second one is listed in any case.
///
/// # Errors
/// [`Status::OutOfMemory`]. A file that cannot be read is none here.
pub fn sources(path: &Path) -> Result<Vec<PathBuf>, Error> {
    let mut list = Vec::new();
    let own =
        output_files::copied(path, 0).map_err(|e| output_files::file_error(path, "copy the name", &e))?;
    fallible::push(&mut list, own)?;
    if !matches!(Format::of(path), Ok(Format::Poly | Format::Smesh)) {
        return Ok(list);
    }
    let beside = match std::fs::metadata(path) {
        Ok(metadata) if metadata.is_file() => {
            bytes_of(path, &Control::free()).is_ok_and(|bytes| tetgen::lacks_points(&bytes))
        }
        _ => true,
    };
    if beside {
        fallible::push(&mut list, output_files::with_extension(path, "node")?)?;
    }
    Ok(list)
}

/// Reads a PLC from the content of a file of a surface format.
///
/// # Errors
/// As [`read`]; a `.poly` or `.smesh` must contain its points.
pub fn read_bytes(bytes: &[u8], format: Format) -> Result<Plc, Error> {
    let no_points = || Err(Error::new(Status::Format, "the file contains no points"));
    parse(bytes, format, no_points, &Control::free())
}

fn parse(
    bytes: &[u8],
    format: Format,
    nodes: impl FnOnce() -> Result<Vec<u8>, Error>,
    control: &Control,
) -> Result<Plc, Error> {
    if bytes.is_empty() {
        return Err(Error::new(Status::Format, "the file is empty"));
    }
    let outcome = match format {
        Format::Off => off::read(bytes, control),
        Format::Stl => stl::read(bytes, control),
        Format::Obj => obj::read(bytes, control),
        Format::Ply => ply::read(bytes, control),
        Format::Poly => tetgen::read_plc(bytes, false, nodes, control),
        Format::Smesh => tetgen::read_plc(bytes, true, nodes, control),
        Format::Node => tetgen::read_node(bytes, control),
        _ => {
            let message = "a mesh format, where a surface or points were expected";
            return Err(Error::new(Status::Unsupported, message));
        }
    };
    // A reader that was ended sees a file that ends.
    control.look()?;
    match outcome {
        Ok(mut plc) if !plc.points.is_empty() => {
            if matches!(format, Format::Off | Format::Poly | Format::Smesh) {
                groups::names_in_comments(bytes, &mut plc)?;
            }
            Ok(plc)
        }
        Ok(_) => Err(Error::new(Status::Format, "the file holds no points")),
        Err(error) if error.status == Status::Format => Err(match sniff::other_kind(bytes, format) {
            Some(kind) => Error::new(Status::Format, format_args!("not {}: it is {kind}", format.noun())),
            None => error,
        }),
        Err(error) => Err(error),
    }
}

fn bytes_of(path: &Path, control: &Control) -> Result<Vec<u8>, Error> {
    /// Read at once: some milliseconds' work.
    const PART: u64 = 1 << 22;
    refuse_endless(path)?;
    let failed = |e| output_files::file_error(path, "read", &e);
    let file = File::open(path).map_err(failed)?;
    let size = file.metadata().map_or(0, |metadata| metadata.len() as usize);
    control.room(size)?;
    let mut bytes = Vec::new();
    // One byte more, so that the end is noticed without growing.
    bytes.try_reserve_exact(size.saturating_add(1))?;
    while (&file).take(PART).read_to_end(&mut bytes).map_err(failed)? > 0 {
        control.look()?;
    }
    Ok(bytes)
}

/// Folders cannot be read, and devices may never end.
fn refuse_endless(path: &Path) -> Result<(), Error> {
    let Ok(metadata) = std::fs::metadata(path) else { return Ok(()) };
    let kind = metadata.file_type();
    #[cfg(unix)]
    let device = {
        use std::os::unix::fs::FileTypeExt;
        kind.is_char_device() || kind.is_block_device() || kind.is_socket()
    };
    #[cfg(not(unix))]
    let device = false;
    let what = match (kind.is_dir(), device) {
        (true, _) => "a folder",
        (_, true) => "a device",
        _ => return Ok(()),
    };
    Err(Error::new(Status::File, format_args!("{}: cannot read: it is {what}, not a file", path.display())))
}

/// The text in lower case; as it is if it is longer than the buffer.
fn lowercase<'a>(text: &'a str, buffer: &'a mut [u8]) -> &'a str {
    let Some(buffer) = buffer.get_mut(..text.len()) else { return text };
    buffer.copy_from_slice(text.as_bytes());
    buffer.make_ascii_lowercase();
    std::str::from_utf8(buffer).unwrap_or(text)
}

/// Puts the file's name before the message.
fn at(path: &Path, error: Error) -> Error {
    if error.status == Status::File {
        return error;
    }
    error.at(format_args!("{}", path.display()))
}

/// Writes the points, facets and segments of a PLC in the surface format of the path's extension.
///
/// `.poly` and `.smesh` carry everything that TetGen's formats can; `.off`, `.obj` and `.ply` points, simple polygons and
/// segments with markers; `.stl` triangles: in single precision without markers, as text in full precision with markers. All but
/// `.node` keep the names of markers. Returns warnings of the kind [`WarningKind::LostValue`](crate::WarningKind::LostValue): a
/// point whose coordinates are rounded or that no triangle of an `.stl` has, the first one with an attribute or a marker where the format
/// has none, the first facet and segment where it has none.
///
/// # Errors
/// [`Status::Unsupported`]: no surface format, or the PLC has what the format cannot express (the message says what).
/// [`Status::NonFinitePoint`]: a coordinate is not finite. [`Status::File`]: cannot be written; then nothing is left behind.
pub fn write_surface(path: &Path, plc: &Plc) -> Result<Warnings, Error> {
    write_surface_with(path, plc, &Control::free())
}

/// The same as a part of a run.
///
/// # Errors
/// As [`write_surface`]; those of [`Control::step`].
pub fn write_surface_with(path: &Path, plc: &Plc, control: &Control) -> Result<Warnings, Error> {
    let mut files = output_files::OutputFiles::new(control);
    write_surface::write(&mut files, path, plc)?;
    let lost = write_surface::lost(Format::of(path)?, plc)?;
    files.commit()?;
    Ok(lost)
}

/// Writes a text (a report, say) to a file: complete or not at all.
///
/// # Errors
/// [`Status::File`]: cannot be written; then nothing is left behind.
pub fn write_text(path: &Path, text: &str) -> Result<(), Error> {
    let control = Control::free();
    let mut files = output_files::OutputFiles::new(&control);
    files.write(path, |out| out.put(text))?;
    files.commit()
}

/// The files that a mesh is read from.
struct MeshFiles {
    node: PathBuf,
    ele: PathBuf,
    face: PathBuf,
    parents: PathBuf,
}

impl MeshFiles {
    /// By the name of one of them but `.parents`, or the stem.
    fn of(path: &Path) -> Result<MeshFiles, Error> {
        let known = path
            .extension()
            .is_some_and(|e| ["ele", "node", "face"].iter().any(|k| e.eq_ignore_ascii_case(k)));
        if !known && Format::of(path).is_ok() {
            return Err(Error::new(
                Status::Unsupported,
                format_args!("{}: meshes are read from .ele files", path.display()),
            ));
        }
        let beside = |suffix: &str| match known {
            true => output_files::with_extension(path, suffix),
            false => output_files::with_suffix(path, &[".", suffix]),
        };
        Ok(MeshFiles {
            node: beside("node")?,
            ele: beside("ele")?,
            face: beside("face")?,
            parents: beside("parents")?,
        })
    }
}

/// The files that [`read_mesh`] reads, those that need not be there included.
///
/// # Errors
/// As [`read_mesh`] for the name; [`Status::OutOfMemory`].
pub fn mesh_sources(path: &Path) -> Result<Vec<PathBuf>, Error> {
    let MeshFiles { node, ele, face, parents } = MeshFiles::of(path)?;
    Ok(fallible::collect([node, ele, face, parents])?)
}

/// Reads a mesh from TetGen's files: `STEM.node`, `STEM.ele` and, where it exists, `STEM.face`; `path` is any of these, or
/// the stem. Filled are `points`, `tets`, `tet_region`, `regions` and the corners and markers of `subfaces`; where there is
/// also our own `STEM.parents`, `steiner`, `steiner_terms`, `facet_flips`, `hull_kept` and the facets of `subfaces`. Of second
/// order, nodes in the middle of edges are left out, once it is certain that they are there: tetrahedra have four points.
///
/// # Errors
/// As [`read`].
pub fn read_mesh(path: &Path) -> Result<TetMesh, Error> {
    let MeshFiles { node, ele, face, parents } = MeshFiles::of(path)?;
    let control = &Control::free();
    let (node, elements) = (bytes_of(&node, control)?, bytes_of(&ele, control)?);
    let tetgen::Tets { nodes, middles, tets, attributes } =
        tetgen::read_tets(&node, &elements, control).map_err(|e| at(&ele, e))?;
    drop((node, elements));
    let mut mesh = TetMesh { tets, ..TetMesh::default() };
    if face.exists() {
        let faces = tetgen::read_faces(&bytes_of(&face, control)?, &nodes, middles, control)
            .map_err(|e| at(&face, e))?;
        let subface = |(corners, marker)| Subface { corners, facet: INVALID, marker, tets: [INVALID; 2] };
        mesh.subfaces = fallible::collect(faces.into_iter().map(subface))?;
    }
    mesh.points = nodes.points;
    if parents.exists() {
        parents::read(&bytes_of(&parents, control)?, &mut mesh, control).map_err(|e| at(&parents, e))?;
    }
    // Looked up only, never iterated.
    let mut known_regions = FxHashMap::default();
    mesh.tet_region.try_reserve_exact(mesh.tets.len())?;
    for tet in 0..mesh.tets.len() {
        let attribute = attributes.get(tet).copied().unwrap_or(0.0);
        let next = mesh.regions.len() as u32;
        let region = *fallible::entry(&mut known_regions, attribute.to_bits())?.or_insert(next);
        if region == next {
            let region = crate::output::Region { attribute, seed: INVALID, max_volume: None };
            fallible::push(&mut mesh.regions, region)?;
        }
        fallible::push(&mut mesh.tet_region, region)?;
    }
    Ok(mesh)
}
