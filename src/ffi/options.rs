//! Settings by setters that check at once, and the callbacks.
use super::guard::{free, get_mut, guard_status, invalid, make};
use super::status::{DelotetPhase, DelotetStatus};
use crate::error::Error;
use crate::options::{Mode, Options, Preserve};
use crate::progress::{Observer, Phase};
use std::ffi::{c_char, c_void, CString};
use std::ops::ControlFlow;

/// What is made of the input: one of the DELOTET_MODE_ constants.
pub type DelotetMode = u32;
/// The Delaunay tetrahedralization of the points; segments and facets are ignored.
pub const DELOTET_MODE_DELAUNAY: DelotetMode = 0;
/// The constrained Delaunay tetrahedralization: segments and facets are unions of edges and faces, with Steiner points on
/// segments only. The default.
pub const DELOTET_MODE_CONSTRAINED: DelotetMode = 1;
/// A tetrahedralization that keeps the surface as it is: every triangle of a facet (of general facets: of their triangulation) is a
/// face and every segment an edge, without any point added on them. Points are added inside only, as few as possible.
pub const DELOTET_MODE_PRESERVE: DelotetMode = 2;

/// What DELOTET_MODE_PRESERVE keeps: one of the DELOTET_PRESERVE_ constants.
pub type DelotetPreserve = u32;
/// Every facet and segment. The default.
pub const DELOTET_PRESERVE_ALL: DelotetPreserve = 0;
/// The outer boundary: facets with the mesh on one side, and segments on these. Others (interfaces of regions, dangling facets) are
/// unions of faces and edges, with Steiner points on their segments where they would cost points inside.
pub const DELOTET_PRESERVE_OUTER: DelotetPreserve = 1;

/// Receives progress: `fraction` of `phase` is done, from 0 to 1, never falling within a phase. Return 0 to go on, anything
/// else to cancel: the call then fails with DELOTET_STATUS_CANCELLED. Called on the thread that made the call. Must not throw,
/// must not longjmp, must not use the handles of the call.
pub type DelotetProgressFn =
    Option<unsafe extern "C" fn(user_data: *mut c_void, phase: DelotetPhase, fraction: f64) -> i32>;

/// Receives a line of text about the run; `message` is UTF-8 and valid during the call of the callback only. Called on the
/// thread that made the call. Must not throw, must not longjmp, must not use the handles of the call.
pub type DelotetLogFn = Option<unsafe extern "C" fn(user_data: *mut c_void, message: *const c_char)>;

/// Settings of a run. One object may serve any number of runs, also at the same time (the callbacks are then called from all
/// their threads).
pub struct DelotetOptions {
    pub(super) options: Options,
    pub(super) callbacks: Callbacks,
}

/// The caller's callbacks.
#[derive(Clone, Copy)]
pub(super) struct Callbacks {
    progress: DelotetProgressFn,
    progress_data: *mut c_void,
    log: DelotetLogFn,
    log_data: *mut c_void,
}

// SAFETY: the pointers are only handed back to the caller's own functions; the header tells the caller that runs on several
// threads with the same options call them from all these threads.
unsafe impl Send for Callbacks {}
// SAFETY: as above; nothing here is changed through a shared reference.
unsafe impl Sync for Callbacks {}

impl Callbacks {
    /// No callbacks.
    pub(super) const NONE: Callbacks = Callbacks {
        progress: None,
        progress_data: std::ptr::null_mut(),
        log: None,
        log_data: std::ptr::null_mut(),
    };
}

impl Observer for Callbacks {
    fn progress(&mut self, phase: Phase, fraction: f64) -> ControlFlow<()> {
        let Some(callback) = self.progress else { return ControlFlow::Continue(()) };
        // SAFETY: the caller set this function together with this pointer.
        match unsafe { callback(self.progress_data, phase.into(), fraction) } {
            0 => ControlFlow::Continue(()),
            _ => ControlFlow::Break(()),
        }
    }

    fn log(&mut self, message: &str) {
        let Some(callback) = self.log else { return };
        let Ok(text) = CString::new(message.replace('\0', " ")) else { return };
        // SAFETY: the caller set this function together with this pointer; the text lives until it returns.
        unsafe { callback(self.log_data, text.as_ptr()) }
    }
}

/// The settings behind a handle that may be null (the defaults).
///
/// # Safety
/// `options` is null or valid.
pub(super) unsafe fn settings(options: *const DelotetOptions) -> (Options, Callbacks) {
    // SAFETY: the caller promises that a handle that is not null is valid.
    match unsafe { options.as_ref() } {
        Some(options) => (options.options.clone(), options.callbacks),
        None => (Options::default(), Callbacks::NONE),
    }
}

/// New options with the defaults that the setters document. The caller owns them: free with delotet_options_free. NULL only if
/// memory ran out.
#[no_mangle]
#[must_use]
pub extern "C" fn delotet_options_new() -> *mut DelotetOptions {
    make(|| DelotetOptions { options: Options::default(), callbacks: Callbacks::NONE })
}

/// Runs the body of a setter.
///
/// # Safety
/// `options` is null or valid, and nothing else uses it.
unsafe fn change(
    options: *mut DelotetOptions,
    body: impl FnOnce(&mut DelotetOptions) -> Result<(), Error>,
) -> DelotetStatus {
    // SAFETY: the caller promises that a handle that is not null is valid and not shared.
    guard_status(|| body(unsafe { get_mut(options, "options") }?))
}

/// What is made: a DELOTET_MODE_ constant. Default: DELOTET_MODE_CONSTRAINED. Errors: INVALID_ARGUMENT (other values).
#[no_mangle]
pub unsafe extern "C" fn delotet_options_set_mode(
    options: *mut DelotetOptions,
    mode: DelotetMode,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses.
    unsafe {
        change(options, |options| {
            options.options.mode = match mode {
                DELOTET_MODE_DELAUNAY => Mode::Delaunay,
                DELOTET_MODE_CONSTRAINED => Mode::Constrained,
                DELOTET_MODE_PRESERVE => Mode::Preserve,
                _ => return Err(invalid("unknown mode")),
            };
            Ok(())
        })
    }
}

/// What DELOTET_MODE_PRESERVE keeps: a DELOTET_PRESERVE_ constant; other modes do not ask. Default: DELOTET_PRESERVE_ALL.
/// Errors: INVALID_ARGUMENT (other values).
#[no_mangle]
pub unsafe extern "C" fn delotet_options_set_preserve(
    options: *mut DelotetOptions,
    preserve: DelotetPreserve,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses.
    unsafe {
        change(options, |options| {
            options.options.preserve = match preserve {
                DELOTET_PRESERVE_ALL => Preserve::All,
                DELOTET_PRESERVE_OUTER => Preserve::Outer,
                _ => return Err(invalid("unknown strength of preserving")),
            };
            Ok(())
        })
    }
}

/// Keep every tetrahedron of the convex hull, holes and outside included (holes given by seeds are still carved).
/// Default: false. Errors: INVALID_ARGUMENT (NULL).
#[no_mangle]
pub unsafe extern "C" fn delotet_options_set_keep_hull(
    options: *mut DelotetOptions,
    keep_hull: bool,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses.
    unsafe {
        change(options, |options| {
            options.options.keep_hull = keep_hull;
            Ok(())
        })
    }
}

/// Take facets with equal markers that meet above `angle` degrees (90 to 180) as one smooth patch, and flip its triangles to be
/// Delaunay on the surface first; delotet_mesh_facet_flips reports the flips. 0: off, the default. Errors: INVALID_ARGUMENT.
#[no_mangle]
pub unsafe extern "C" fn delotet_options_set_merge_facets(
    options: *mut DelotetOptions,
    angle: f64,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses.
    unsafe {
        change(options, |options| {
            options.options.merge_facets = match angle {
                0.0 => None,
                90.0..=180.0 => Some(angle),
                _ => return Err(invalid("the angle is neither 0 nor between 90 and 180 degrees")),
            };
            Ok(())
        })
    }
}

/// Look for self-intersections and all other defects before meshing. Default: true. Without it an invalid PLC may end in
/// DELOTET_STATUS_INTERNAL. Errors: INVALID_ARGUMENT (NULL).
#[no_mangle]
pub unsafe extern "C" fn delotet_options_set_validate(
    options: *mut DelotetOptions,
    validate: bool,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses.
    unsafe {
        change(options, |options| {
            options.options.validate = validate;
            Ok(())
        })
    }
}

/// How many defects an error lists at most. Default: 1000. Errors: INVALID_ARGUMENT (NULL).
#[no_mangle]
pub unsafe extern "C" fn delotet_options_set_max_defects(
    options: *mut DelotetOptions,
    max_defects: usize,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses.
    unsafe {
        change(options, |options| {
            options.options.max_defects = max_defects;
            Ok(())
        })
    }
}

/// Worker threads, at least 1. The mesh does not depend on it, bit for bit. Default: 1. Errors: INVALID_ARGUMENT (0).
#[no_mangle]
pub unsafe extern "C" fn delotet_options_set_threads(
    options: *mut DelotetOptions,
    threads: usize,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses.
    unsafe {
        change(options, |options| {
            if threads == 0 {
                return Err(invalid("at least one thread is needed"));
            }
            options.options.threads = threads;
            Ok(())
        })
    }
}

/// Give up with DELOTET_STATUS_STEINER_LIMIT beyond this many Steiner points. UINT64_MAX: the default, 100,000 and 100 more
/// per segment.
/// Errors: INVALID_ARGUMENT (NULL).
#[no_mangle]
pub unsafe extern "C" fn delotet_options_set_steiner_limit(
    options: *mut DelotetOptions,
    limit: u64,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses.
    unsafe {
        change(options, |options| {
            options.options.steiner_limit = (limit != u64::MAX).then_some(limit);
            Ok(())
        })
    }
}

/// Return the mesh also if some Steiner points have no valid position in doubles, instead of DELOTET_STATUS_ROUNDING:
/// delotet_mesh_crowded_points() lists them, tetrahedra at them may be flat or inverted in doubles, and the exact mesh is
/// given by delotet_mesh_steiner_points(). Default: false. Errors: INVALID_ARGUMENT (NULL).
#[no_mangle]
pub unsafe extern "C" fn delotet_options_set_exact_form(
    options: *mut DelotetOptions,
    exact_form: bool,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses.
    unsafe {
        change(options, |options| {
            options.options.exact_form = exact_form;
            Ok(())
        })
    }
}

/// The points are already in a spatially coherent order: skip sorting. Default: false. Errors: INVALID_ARGUMENT (NULL).
#[no_mangle]
pub unsafe extern "C" fn delotet_options_set_points_sorted(
    options: *mut DelotetOptions,
    points_sorted: bool,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses.
    unsafe {
        change(options, |options| {
            options.options.points_sorted = points_sorted;
            Ok(())
        })
    }
}

/// Progress goes to `callback` together with `user_data`, which is only handed through. NULL: nowhere, the default.
/// Errors: INVALID_ARGUMENT (options is NULL).
#[no_mangle]
pub unsafe extern "C" fn delotet_options_set_progress(
    options: *mut DelotetOptions,
    callback: DelotetProgressFn,
    user_data: *mut c_void,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses.
    unsafe {
        change(options, |options| {
            options.callbacks.progress = callback;
            options.callbacks.progress_data = user_data;
            Ok(())
        })
    }
}

/// Log lines go to `callback` together with `user_data`, which is only handed through. NULL: nowhere, the default; the library
/// itself never prints. Errors: INVALID_ARGUMENT (options is NULL).
#[no_mangle]
pub unsafe extern "C" fn delotet_options_set_log(
    options: *mut DelotetOptions,
    callback: DelotetLogFn,
    user_data: *mut c_void,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses.
    unsafe {
        change(options, |options| {
            options.callbacks.log = callback;
            options.callbacks.log_data = user_data;
            Ok(())
        })
    }
}

/// Frees options. NULL is ignored. Not while a run uses them.
#[no_mangle]
pub unsafe extern "C" fn delotet_options_free(options: *mut DelotetOptions) {
    // SAFETY: the caller passes NULL or options that it owns.
    unsafe { free(options) }
}
