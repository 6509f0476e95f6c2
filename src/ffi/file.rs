//! Reading and writing files.
use crate::control::Control;
use crate::error::Error;
use crate::ffi::error::DelotetError;
use crate::ffi::guard::{get, guard, null, Out};
use crate::ffi::mesh::DelotetMesh;
use crate::ffi::options::{with_settings, DelotetOptions};
use crate::ffi::plc::DelotetPlc;
use crate::ffi::status::DelotetStatus;
use crate::options::WriteOptions;
use libc::c_char;
use std::ffi::CStr;
use std::path::Path;

/// The path behind a C string: any bytes on Unix, UTF-8 elsewhere.
///
/// # Safety
/// `path` is null or a zero-terminated string valid for `'a`.
pub(super) unsafe fn path_of<'a>(path: *const c_char) -> Result<&'a Path, Error> {
    if path.is_null() {
        return Err(null("path"));
    }
    // SAFETY: not null, and the caller promises a terminator.
    let text = unsafe { CStr::from_ptr(path) };
    #[cfg(unix)]
    {
        use std::os::unix::ffi::OsStrExt;
        Ok(Path::new(std::ffi::OsStr::from_bytes(text.to_bytes())))
    }
    #[cfg(not(unix))]
    {
        text.to_str().map(Path::new).map_err(|_| super::guard::invalid("path is not UTF-8"))
    }
}

/// Reads a PLC from a file; the extension determines the format (src/doc/formats.md lists them).
/// `path`: zero-terminated; any bytes on Unix, UTF-8 elsewhere. `out_plc`: the PLC, owned by the caller; free it with delotet_plc_free().
/// NULL on failure.
/// Errors: INVALID_ARGUMENT, UNSUPPORTED (unknown format, or the library was built without file formats), FILE, FORMAT,
/// INDEX_OUT_OF_RANGE, TOO_LARGE, OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_plc_read(
    path: *const c_char,
    out_plc: *mut *mut DelotetPlc,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a zero-terminated path, and NULL or valid out-parameters.
    unsafe {
        guard(out_error, || {
            let out = Out::new(out_plc, "out_plc")?;
            let plc = files::read(path_of(path)?, &Control::free())?;
            out.put(DelotetPlc::new(plc)?)
        })
    }
}

/// Reads a PLC like delotet_plc_read(), under the limits of `options` (NULL: none), of which the others have no effect.
/// Errors: as delotet_plc_read(); CANCELLED, TIME_LIMIT, MEMORY_LIMIT.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_plc_read_with(
    path: *const c_char,
    options: *const DelotetOptions,
    out_plc: *mut *mut DelotetPlc,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a zero-terminated path, NULL or options that nothing changes meanwhile, and NULL or valid out-parameters.
    unsafe {
        guard(out_error, || {
            let out = Out::new(out_plc, "out_plc")?;
            let path = path_of(path)?;
            let plc = with_settings(options, |_, control| files::read(path, control))?;
            out.put(DelotetPlc::new(plc)?)
        })
    }
}

/// Writes a PLC to a file; the extension determines the format (src/doc/formats.md lists the surface formats). Values that the format
/// cannot hold are lost without a warning; delotet_plc_write_with() reports them.
/// Errors: INVALID_ARGUMENT, UNSUPPORTED (unknown format, one that cannot hold the contents of the PLC, or the library was built without
/// file formats), NON_FINITE_POINT, FILE, OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_plc_write(
    plc: *const DelotetPlc,
    path: *const c_char,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a PLC that nothing changes meanwhile and a zero-terminated path.
    unsafe {
        guard(out_error, || {
            let plc = &get(plc, "plc")?.plc;
            write_surface(path_of(path)?, plc, &WriteOptions::default(), &Control::free())
        })
    }
}

/// Writes a mesh to a file; the extension determines the format (src/doc/formats.md lists them). `plc` is the PLC that the mesh was made
/// from: some formats store its markers and attributes. For a mesh of delotet_mesh_from_arrays() or delotet_mesh_read(), and what was made
/// of it, any PLC will do: one with the input points' markers and attributes, or an empty one. Values that the format cannot hold are lost without a warning;
/// delotet_mesh_write_with() reports them.
/// Errors: INVALID_ARGUMENT, UNSUPPORTED (unknown format, or the library was built without file formats), FILE, OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_mesh_write(
    mesh: *const DelotetMesh,
    plc: *const DelotetPlc,
    path: *const c_char,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes handles that nothing changes meanwhile and a zero-terminated path.
    unsafe {
        guard(out_error, || {
            let (mesh, plc) = (&get(mesh, "mesh")?.mesh, &get(plc, "plc")?.plc);
            write(path_of(path)?, mesh, plc, &WriteOptions::default(), &Control::free())
        })
    }
}

pub(super) use files::{read_mesh, write, write_surface};

#[cfg(feature = "io")]
mod files {
    use crate::io::{Format, MeshFile};
    use crate::query::PointData;
    use crate::{control::Control, error::Error, fallible, MeshArrays, Plc, TetMesh, WriteOptions};
    use std::path::Path;

    pub(super) fn read(path: &Path, control: &Control) -> Result<Plc, Error> {
        crate::io::read_with(path, control)
    }

    pub(in crate::ffi) fn read_mesh(
        path: &Path,
        control: &Control,
    ) -> Result<(MeshArrays, PointData), Error> {
        let MeshFile { arrays, attribute_count, attributes, markers } =
            crate::io::read_arrays_with(path, control)?;
        Ok((arrays, PointData { attribute_count, attributes, markers }))
    }

    pub(in crate::ffi) fn write_surface(
        path: &Path,
        plc: &Plc,
        options: &WriteOptions,
        control: &Control,
    ) -> Result<(), Error> {
        let lost = crate::io::write_surface_with(path, plc, control)?;
        log_unused(path, options, control)?;
        lost.log(control);
        Ok(())
    }

    pub(in crate::ffi) fn write(
        path: &Path,
        mesh: &TetMesh,
        plc: &Plc,
        options: &WriteOptions,
        control: &Control,
    ) -> Result<(), Error> {
        let lost = crate::io::write_with(path, mesh, plc, options, control)?;
        log_unused(path, options, control)?;
        lost.log(control);
        Ok(())
    }

    fn log_unused(path: &Path, options: &WriteOptions, control: &Control) -> Result<(), Error> {
        options.unused(Format::of(path)?).try_for_each(|option| {
            let name = option.name();
            control.log(&fallible::text(format_args!("warning: {name} has no effect in this format"))?);
            Ok(())
        })
    }
}

#[cfg(not(feature = "io"))]
mod files {
    use crate::error::{Error, Status};
    use crate::query::PointData;
    use crate::{control::Control, MeshArrays, Plc, TetMesh, WriteOptions};
    use std::path::Path;

    fn absent() -> Error {
        Error::new(Status::Unsupported, "this library was built without file formats")
    }

    pub(super) fn read(_: &Path, _: &Control) -> Result<Plc, Error> {
        Err(absent())
    }

    pub(in crate::ffi) fn read_mesh(_: &Path, _: &Control) -> Result<(MeshArrays, PointData), Error> {
        Err(absent())
    }

    pub(in crate::ffi) fn write_surface(
        _: &Path,
        _: &Plc,
        _: &WriteOptions,
        _: &Control,
    ) -> Result<(), Error> {
        Err(absent())
    }

    pub(in crate::ffi) fn write(
        _: &Path,
        _: &TetMesh,
        _: &Plc,
        _: &WriteOptions,
        _: &Control,
    ) -> Result<(), Error> {
        Err(absent())
    }
}
