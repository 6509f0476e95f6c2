//! Writing meshes: the options, with setters that validate at once, and the call itself.
use crate::control::{controlled, Control, Limits};
use crate::error::Error;
use crate::fallible;
use crate::ffi::error::{c_text, DelotetError};
use crate::ffi::file::path_of;
use crate::ffi::guard::{free, get, get_mut, guard, invalid, make, read};
use crate::ffi::limits;
use crate::ffi::limits::{DelotetCancelToken, Shared};
use crate::ffi::mesh::DelotetMesh;
use crate::ffi::options::{Callbacks, DelotetLogFn};
use crate::ffi::plc::DelotetPlc;
use crate::ffi::status::DelotetStatus;
use crate::options::{MshVersion, WriteOptions};
use libc::{c_char, c_void};
use std::ffi::CStr;
use std::time::Duration;

/// A version of Gmsh's format: one of the DELOTET_MSH_ constants.
pub type DelotetMshVersion = u32;
/// Version 4.1, that of Gmsh 4. The default.
pub const DELOTET_MSH_4_1: DelotetMshVersion = 41;
/// Version 2.2, which many solvers read; some read no other.
pub const DELOTET_MSH_2_2: DelotetMshVersion = 22;

/// How a mesh or a PLC is written. One object may serve any number of calls, even concurrent ones (the log callback is then called
/// from all their threads).
pub struct DelotetWriteOptions {
    options: WriteOptions,
    /// The names of `options.region_names` as C strings.
    names: Vec<Vec<u8>>,
    callbacks: Callbacks,
    cancel: Option<Shared>,
    time_limit: Option<Duration>,
}

/// New options with the defaults that the setters document. The caller owns them; free them with delotet_write_options_free(). NULL only if
/// memory ran out.
#[no_mangle]
#[must_use]
pub extern "C" fn delotet_write_options_new() -> *mut DelotetWriteOptions {
    make(|| DelotetWriteOptions {
        options: WriteOptions::default(),
        names: Vec::new(),
        callbacks: Callbacks::NONE,
        cancel: None,
        time_limit: None,
    })
}

/// Runs the body of a setter.
///
/// # Safety
/// `options` is null or valid, and nothing else uses it; `out_error` is null or valid for one write.
unsafe fn change(
    options: *mut DelotetWriteOptions,
    out_error: *mut *mut DelotetError,
    body: impl FnOnce(&mut DelotetWriteOptions) -> Result<(), Error>,
) -> DelotetStatus {
    // SAFETY: the caller promises that a handle that is not null is valid and not shared, and so for `out_error`.
    unsafe { guard(out_error, || body(get_mut(options, "options")?)) }
}

/// .vtu: compress the arrays with zlib, which makes smaller files more slowly. Other formats ignore it. Default: false. Errors:
/// INVALID_ARGUMENT (NULL).
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_write_options_set_compress(
    options: *mut DelotetWriteOptions,
    compress: bool,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, and NULL or a valid out-parameter.
    unsafe {
        change(options, out_error, |o| {
            o.options.compress = compress;
            Ok(())
        })
    }
}

/// .vtu: also write the subfaces, to STEM_subfaces.vtu for STEM.vtu. Other formats ignore it: they always contain the subfaces, except
/// .vtk, which never does. Default: false. Errors: INVALID_ARGUMENT (NULL).
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_write_options_set_subfaces(
    options: *mut DelotetWriteOptions,
    subfaces: bool,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, and NULL or a valid out-parameter.
    unsafe {
        change(options, out_error, |o| {
            o.options.subfaces = subfaces;
            Ok(())
        })
    }
}

/// .vtu: also write the quality of each tetrahedron, as delotet_mesh_quality() has it: arrays max_dihedral, radius_edge, eta and volume of
/// doubles beside min_dihedral, which is always written. Other formats ignore it. Default: false. Errors: INVALID_ARGUMENT (NULL).
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_write_options_set_quality_data(
    options: *mut DelotetWriteOptions,
    quality_data: bool,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, and NULL or a valid out-parameter.
    unsafe {
        change(options, out_error, |o| {
            o.options.quality_data = quality_data;
            Ok(())
        })
    }
}

/// Write tetrahedra of ten nodes: the corners, then the midpoints of the edges in the order of the format. Writing .mesh then fails.
/// Default: false. Errors: INVALID_ARGUMENT (NULL).
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_write_options_set_second_order(
    options: *mut DelotetWriteOptions,
    second_order: bool,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, and NULL or a valid out-parameter.
    unsafe {
        change(options, out_error, |o| {
            o.options.second_order = second_order;
            Ok(())
        })
    }
}

/// .msh: sets the version, a DELOTET_MSH_ constant. Other formats ignore it. Default: DELOTET_MSH_4_1. Errors: INVALID_ARGUMENT (other
/// values).
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_write_options_set_msh_version(
    options: *mut DelotetWriteOptions,
    version: DelotetMshVersion,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, and NULL or a valid out-parameter.
    unsafe {
        change(options, out_error, |o| {
            o.options.msh_version = match version {
                DELOTET_MSH_4_1 => MshVersion::V41,
                DELOTET_MSH_2_2 => MshVersion::V22,
                _ => {
                    return Err(invalid(format_args!(
                        "msh_version: {version} is not a DELOTET_MSH_ constant"
                    )))
                }
            };
            Ok(())
        })
    }
}

/// .msh, .inp: names the regions with an attribute; other formats ignore it. `name`: zero-terminated UTF-8; its first line is copied; NULL
/// or "" removes the name. Default: no names.
/// Errors: INVALID_ARGUMENT (NULL, an attribute that is not finite, a name that is not UTF-8), OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_write_options_set_region_name(
    options: *mut DelotetWriteOptions,
    attribute: f64,
    name: *const c_char,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, NULL or a zero-terminated name, and NULL or a valid
    // out-parameter.
    unsafe {
        change(options, out_error, |o| {
            let name = if name.is_null() { c"" } else { CStr::from_ptr(name) };
            o.set_region_name(attribute, name)
        })
    }
}

impl DelotetWriteOptions {
    fn set_region_name(&mut self, attribute: f64, name: &CStr) -> Result<(), Error> {
        let text = name.to_str().map_err(|_| invalid("region_name: the name is not UTF-8"))?;
        if !attribute.is_finite() {
            return Err(invalid("region_name: the attribute is not finite"));
        }
        if let Some(at) = self.options.region_names.iter().position(|n| n.attribute == attribute) {
            self.options.region_names.remove(at);
            self.names.remove(at);
        }
        if text.is_empty() {
            return Ok(());
        }
        let kept = c_text(text)?;
        self.names.try_reserve(1)?;
        self.options.set_region_name(attribute, text)?;
        Ok(fallible::push(&mut self.names, kept)?)
    }
}

/// Sets the callback that receives log lines; `user_data` is passed to it unchanged. There is one line "warning: ..." for each kind of data
/// that the format cannot hold and for each option without effect in it. NULL, the default: none.
/// Errors: INVALID_ARGUMENT (options is NULL).
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_write_options_set_log(
    options: *mut DelotetWriteOptions,
    callback: DelotetLogFn,
    user_data: *mut c_void,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, and NULL or a valid out-parameter.
    unsafe {
        change(options, out_error, |o| {
            o.callbacks.log = callback;
            o.callbacks.log_data = user_data;
            Ok(())
        })
    }
}

/// Sets the token that cancels writing: nothing is left behind then. NULL, the default: none. Errors: INVALID_ARGUMENT (options is NULL).
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_write_options_set_cancel_token(
    options: *mut DelotetWriteOptions,
    token: *const DelotetCancelToken,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, NULL or a valid token, and NULL or a valid out-parameter.
    unsafe {
        change(options, out_error, |o| {
            o.cancel = Shared::new(token);
            Ok(())
        })
    }
}

/// Fail with DELOTET_STATUS_TIME_LIMIT this many seconds after the beginning of a call; nothing is left behind then. 0, the default: no
/// limit. Errors: INVALID_ARGUMENT (negative or not finite).
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_write_options_set_time_limit(
    options: *mut DelotetWriteOptions,
    seconds: f64,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, and NULL or a valid out-parameter.
    unsafe {
        change(options, out_error, |o| {
            o.time_limit = limits::time_limit(seconds)?;
            Ok(())
        })
    }
}

/// The settings of a handle, the defaults for NULL.
///
/// # Safety
/// `options` is null or valid.
unsafe fn setting<R>(options: *const DelotetWriteOptions, body: impl FnOnce(&WriteOptions) -> R) -> R {
    // SAFETY: the caller promises that a handle that is not null is valid.
    match unsafe { options.as_ref() } {
        Some(options) => body(&options.options),
        None => body(&WriteOptions::default()),
    }
}

/// Runs `body` with the settings of a handle, under its limits and with its log callback; with the defaults for NULL.
///
/// # Safety
/// `options` is null or valid.
unsafe fn with_settings<R>(
    options: *const DelotetWriteOptions,
    body: impl FnOnce(&WriteOptions, &Control) -> R,
) -> R {
    // SAFETY: the caller promises that a handle that is not null is valid.
    let Some(handle) = (unsafe { options.as_ref() }) else {
        return body(&WriteOptions::default(), &Control::free());
    };
    let (mut callbacks, cancel) = (handle.callbacks, handle.cancel.as_ref().map(Shared::share));
    let limits = limits::with_token(Limits { time: handle.time_limit, ..Limits::default() }, &cancel);
    controlled(limits, &mut callbacks, |control| body(&handle.options, control))
}

/// Whether arrays are compressed, as set by delotet_write_options_set_compress(). All getters return the default for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_write_options_compress(options: *const DelotetWriteOptions) -> bool {
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile.
    unsafe { setting(options, |o| o.compress) }
}

/// Whether subfaces are also written, as set by delotet_write_options_set_subfaces().
#[no_mangle]
pub unsafe extern "C" fn delotet_write_options_subfaces(options: *const DelotetWriteOptions) -> bool {
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile.
    unsafe { setting(options, |o| o.subfaces) }
}

/// Whether the quality of tetrahedra is also written, as set by delotet_write_options_set_quality_data().
#[no_mangle]
pub unsafe extern "C" fn delotet_write_options_quality_data(options: *const DelotetWriteOptions) -> bool {
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile.
    unsafe { setting(options, |o| o.quality_data) }
}

/// Whether tetrahedra have ten nodes, as set by delotet_write_options_set_second_order().
#[no_mangle]
pub unsafe extern "C" fn delotet_write_options_second_order(options: *const DelotetWriteOptions) -> bool {
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile.
    unsafe { setting(options, |o| o.second_order) }
}

/// The version of .msh, as set by delotet_write_options_set_msh_version().
#[no_mangle]
pub unsafe extern "C" fn delotet_write_options_msh_version(
    options: *const DelotetWriteOptions,
) -> DelotetMshVersion {
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile.
    unsafe {
        setting(options, |o| match o.msh_version {
            MshVersion::V41 => DELOTET_MSH_4_1,
            MshVersion::V22 => DELOTET_MSH_2_2,
        })
    }
}

/// The name of the regions with an attribute, UTF-8; NULL if they have none. Borrowed from `options`: valid until they are changed or
/// freed.
#[no_mangle]
pub unsafe extern "C" fn delotet_write_options_region_name(
    options: *const DelotetWriteOptions,
    attribute: f64,
) -> *const c_char {
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile.
    unsafe {
        read(options, std::ptr::null(), |o| {
            let at = o.options.region_names.iter().position(|n| n.attribute == attribute);
            at.and_then(|at| o.names.get(at)).map_or(std::ptr::null(), |name| name.as_ptr().cast())
        })
    }
}

/// The log callback, NULL if there is none, as set by delotet_write_options_set_log().
/// `out_user_data`: NULL, or receives the pointer that was set with it (NULL without a callback).
#[no_mangle]
pub unsafe extern "C" fn delotet_write_options_log(
    options: *const DelotetWriteOptions,
    out_user_data: *mut *mut c_void,
) -> DelotetLogFn {
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile.
    let callbacks = unsafe { read(options, Callbacks::NONE, |o| o.callbacks) };
    if !out_user_data.is_null() {
        // SAFETY: not null, and the caller promises that it is valid for a write.
        unsafe { out_user_data.write(callbacks.log_data) };
    }
    callbacks.log
}

/// The token, NULL if there is none, as set by delotet_write_options_set_cancel_token(). Borrowed from `options`: valid until they get
/// another one or are freed.
#[no_mangle]
pub unsafe extern "C" fn delotet_write_options_cancel_token(
    options: *const DelotetWriteOptions,
) -> *const DelotetCancelToken {
    let none = std::ptr::null();
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile.
    unsafe { read(options, none, |o| o.cancel.as_ref().map_or(none, Shared::as_ptr)) }
}

/// The limit on time in seconds, 0 if there is none, as set by delotet_write_options_set_time_limit().
#[no_mangle]
pub unsafe extern "C" fn delotet_write_options_time_limit(options: *const DelotetWriteOptions) -> f64 {
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile.
    unsafe { read(options, 0.0, |o| limits::seconds(o.time_limit)) }
}

/// Frees options. NULL is ignored. No call may be using them.
#[no_mangle]
pub unsafe extern "C" fn delotet_write_options_free(options: *mut DelotetWriteOptions) {
    // SAFETY: the caller passes NULL or options that it owns.
    unsafe { free(options) }
}

/// Writes a mesh to a file like delotet_mesh_write(), with `options` (NULL: the defaults). The log callback is told what the format cannot
/// hold; src/doc/formats.md says what each format holds.
/// Errors: INVALID_ARGUMENT, UNSUPPORTED (unknown format, one without second order, or the library was built without file formats), FILE,
/// TOO_LARGE, CANCELLED, TIME_LIMIT, OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_mesh_write_with(
    mesh: *const DelotetMesh,
    plc: *const DelotetPlc,
    path: *const c_char,
    options: *const DelotetWriteOptions,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes handles that nothing changes meanwhile and a zero-terminated path.
    unsafe {
        guard(out_error, || {
            let (mesh, plc) = (&get(mesh, "mesh")?.mesh, &get(plc, "plc")?.plc);
            let path = path_of(path)?;
            with_settings(options, |o, control| super::file::write(path, mesh, plc, o, control))
        })
    }
}

/// Writes a PLC to a file like delotet_plc_write(), and reports values that the format cannot hold to the log callback of `options` (NULL:
/// no callback). The other options have no effect on surface formats; the log names those that are set.
/// Errors: INVALID_ARGUMENT, UNSUPPORTED (unknown format, one that cannot hold the contents of the PLC, or the library was built without
/// file formats), NON_FINITE_POINT, FILE, CANCELLED, TIME_LIMIT, OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_plc_write_with(
    plc: *const DelotetPlc,
    path: *const c_char,
    options: *const DelotetWriteOptions,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes handles that nothing changes meanwhile and a zero-terminated path.
    unsafe {
        guard(out_error, || {
            let (plc, path) = (&get(plc, "plc")?.plc, path_of(path)?);
            with_settings(options, |o, control| super::file::write_surface(path, plc, o, control))
        })
    }
}
