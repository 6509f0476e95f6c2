//! Writing meshes to files: the options of each format, and its writer.
use crate::control::Control;
use crate::error::{Error, Status};
use crate::fallible;
use crate::io::model::Model;
use crate::io::output_files;
use crate::io::output_files::OutputFiles;
use crate::io::tags;
use crate::io::tags::Groups;
use crate::io::{inp, medit, msh, vtk, vtu, write_tetgen, Format};
use crate::options::{MshVersion, WriteOptions};
use crate::output::TetMesh;
use crate::plc::Plc;
use crate::warning::Warnings;
use std::path::{Path, PathBuf};

/// An option of [`WriteOptions`] without effect in a format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum UnusedOption {
    /// [`WriteOptions::compress`].
    Compress,
    /// [`WriteOptions::subfaces`].
    Subfaces,
    /// [`WriteOptions::quality_data`].
    QualityData,
    /// [`WriteOptions::second_order`].
    SecondOrder,
    /// [`WriteOptions::msh_version`].
    MshVersion,
    /// [`WriteOptions::region_names`].
    RegionNames,
}

impl UnusedOption {
    /// The option's name, as setters have it.
    pub fn name(self) -> &'static str {
        match self {
            UnusedOption::Compress => "compress",
            UnusedOption::Subfaces => "subfaces",
            UnusedOption::QualityData => "quality_data",
            UnusedOption::SecondOrder => "second_order",
            UnusedOption::MshVersion => "msh_version",
            UnusedOption::RegionNames => "region_name",
        }
    }
}

impl WriteOptions {
    /// Whether a mesh can be written to `path` with these options.
    ///
    /// # Errors
    /// [`Status::Unsupported`]: no mesh format, or second order where the format has none in common use.
    pub fn check(&self, path: &Path) -> Result<(), Error> {
        let format = Format::of(path)?;
        let what = if !format.is_mesh() {
            "not a mesh format; .vtu .vtk .msh .inp .mesh .ele are"
        } else if self.second_order && format == Format::Medit {
            "second-order tetrahedra have no common form in .mesh files; .vtu .vtk .msh .inp .ele have"
        } else {
            return Ok(());
        };
        Err(Error::new(Status::Unsupported, fallible::text(format_args!("{}: {what}", path.display()))?))
    }

    /// Options that differ from the default and do nothing in a format, of meshes or of surfaces.
    pub fn unused(&self, format: Format) -> impl Iterator<Item = UnusedOption> {
        let named = matches!(format, Format::Msh | Format::Inp);
        let set = [
            (self.compress && format != Format::Vtu, UnusedOption::Compress),
            (self.subfaces && format != Format::Vtu, UnusedOption::Subfaces),
            (self.quality_data && format != Format::Vtu, UnusedOption::QualityData),
            (self.second_order && format.is_surface(), UnusedOption::SecondOrder),
            (self.msh_version != MshVersion::V41 && format != Format::Msh, UnusedOption::MshVersion),
            (!self.region_names.is_empty() && !named, UnusedOption::RegionNames),
        ];
        set.into_iter().filter(|x| x.0).map(|x| x.1)
    }
}

/// Writes a mesh in the format of the path's extension. `plc` is what it was made of: it gives the attributes and markers of points
/// and the names of markers. Returns warnings of the kind [`WarningKind::LostValue`](crate::WarningKind::LostValue) for what the
/// format cannot hold as it is.
///
/// # Errors
/// [`Status::Unsupported`]: as [`WriteOptions::check`]. [`Status::File`]: cannot be written; then nothing is left behind.
/// [`Status::InvalidArgument`], [`Status::IndexOutOfRange`]: second order of a mesh that contradicts itself.
/// [`Status::TooLarge`]: more second-order nodes than 32-bit indices can address. [`Status::OutOfMemory`].
pub fn write(path: &Path, mesh: &TetMesh, plc: &Plc, options: &WriteOptions) -> Result<Warnings, Error> {
    write_with(path, mesh, plc, options, &Control::free())
}

/// The same as a part of a run.
///
/// # Errors
/// As [`write()`]; those of [`Control::step`].
pub fn write_with(
    path: &Path,
    mesh: &TetMesh,
    plc: &Plc,
    options: &WriteOptions,
    control: &Control,
) -> Result<Warnings, Error> {
    options.check(path)?;
    let mut warnings = Warnings::default();
    let model = Model::new(mesh, plc, options)?;
    let mut files = OutputFiles::new(control);
    match Format::of(path)? {
        Format::Ele => write_tetgen::write(&mut files, path, &model)?,
        Format::Vtk => files.write(path, |out| vtk::write(out, &model))?,
        Format::Msh => {
            let groups = Groups::new(&model, &mut warnings)?;
            model.lose_attributes(&mut warnings);
            model.lose_markers(&mut warnings);
            files.write(path, |out| match options.msh_version {
                MshVersion::V41 => msh::write(out, &model, &groups),
                MshVersion::V22 => msh::write_legacy(out, &model, &groups),
            })?;
        }
        Format::Inp => {
            let groups = Groups::new(&model, &mut warnings)?;
            let names = inp::Names::new(&groups)?;
            model.lose_attributes(&mut warnings);
            model.lose_markers(&mut warnings);
            inp::lose_digits(&model, &mut warnings);
            files.write(path, |out| inp::write(out, &model, &groups, &names))?;
        }
        Format::Medit => {
            let regions = tags::region_tags(mesh)?;
            tags::lose_attributes(&model, &regions, &mut warnings);
            model.lose_attributes(&mut warnings);
            let references = medit::References { pieces: tags::segment_pieces(mesh)?, regions };
            files.write(path, |out| medit::write(out, &model, &references))?;
        }
        _ => {
            files.write(path, |out| vtu::Grid::tets(&model).write(out))?;
            if options.subfaces {
                let grid = vtu::Grid::subfaces(&model)?;
                // Like `subfaces_path`, with fallible allocation.
                let stem = output_files::with_extension(path, "")?;
                let beside = output_files::with_suffix(&stem, &["_subfaces.vtu"])?;
                files.write(&beside, |out| grid.write(out))?;
            }
        }
    }
    files.commit()?;
    Ok(warnings)
}

/// Where [`WriteOptions::subfaces`] go: `STEM_subfaces.vtu` for `STEM.vtu`.
#[allow(clippy::disallowed_methods, reason = "for callers; the library itself never calls it")]
pub fn subfaces_path(path: &Path) -> PathBuf {
    let mut name = path.file_stem().unwrap_or_default().to_os_string();
    name.push("_subfaces.vtu");
    path.with_file_name(name)
}
