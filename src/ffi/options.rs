//! The options, with setters that validate at once, and the callbacks.
use crate::control::{controlled, Control};
use crate::error::Error;
use crate::ffi::error::{c_text, DelotetError};
use crate::ffi::guard::{free, get_mut, guard, invalid, make, read};
use crate::ffi::limits::{with_token, Shared};
use crate::ffi::sizes::{borrowed, SizeCallback};
use crate::ffi::status::{DelotetPhase, DelotetStatus};
use crate::options::{Mode, Options, Preserve};
use crate::progress::{Observer, Phase};
use crate::query::Background;
use libc::{c_char, c_void};
use std::ops::ControlFlow;

/// What is made from the input: one of the DELOTET_MODE_ constants.
pub type DelotetMode = u32;
/// The Delaunay tetrahedralization of the points; segments and facets are ignored.
pub const DELOTET_MODE_DELAUNAY: DelotetMode = 0;
/// The constrained Delaunay tetrahedralization: segments and facets are unions of edges and faces, with Steiner points on
/// segments only, unless sizes or shapes ask for more points (delotet_options_set_size()). The default.
pub const DELOTET_MODE_CONSTRAINED: DelotetMode = 1;
/// A tetrahedralization that keeps the surface as it is: every triangle is a face, every segment and every edge of a polygon is an
/// edge, and no point is added on them; a polygon may get any diagonals. Points are added only inside, as few as possible.
pub const DELOTET_MODE_PRESERVE: DelotetMode = 2;

/// What DELOTET_MODE_PRESERVE keeps: one of the DELOTET_PRESERVE_ constants.
pub type DelotetPreserve = u32;
/// Every facet and segment. The default.
pub const DELOTET_PRESERVE_ALL: DelotetPreserve = 0;
/// The outer boundary: facets with the mesh on one side, and the segments on them. Other facets and segments (interfaces between regions,
/// dangling facets) are unions of faces and edges, with Steiner points on segments where keeping them would take points inside.
pub const DELOTET_PRESERVE_OUTER: DelotetPreserve = 1;

/// Receives progress: `fraction` of `phase` is done, from 0 to 1. Phases come in order, each once and up to 1 (unneeded ones never), and
/// fractions never decrease: repeated attempts report no progress. delotet_phase_overall() combines both into one number. Return 0 to
/// continue, anything else to cancel: the call then fails with DELOTET_STATUS_CANCELLED. Called on the thread that made the call. Must not
/// throw, must not longjmp, and must not use the handles of the call.
pub type DelotetProgressFn =
    Option<unsafe extern "C" fn(user_data: *mut c_void, phase: DelotetPhase, fraction: f64) -> i32>;

/// Receives a line of text about the run; warnings begin with "warning: " and come at its end, one line per kind. `message` is UTF-8 and
/// valid only during the callback. Called on the thread that made the call. Must not throw, must not longjmp, and must not use the handles
/// of the call.
pub type DelotetLogFn = Option<unsafe extern "C" fn(user_data: *mut c_void, message: *const c_char)>;

/// Settings of a run. One object may serve any number of runs, even concurrent ones (the callbacks are then called from all their threads).
pub struct DelotetOptions {
    pub(super) options: Options,
    pub(super) callbacks: Callbacks,
    pub(super) cancel: Option<Shared>,
    pub(super) background: Option<Background>,
}

/// The caller's callbacks.
#[derive(Clone, Copy)]
pub(super) struct Callbacks {
    progress: DelotetProgressFn,
    progress_data: *mut c_void,
    pub(super) log: DelotetLogFn,
    pub(super) log_data: *mut c_void,
    pub(super) size: SizeCallback,
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
        size: SizeCallback::NONE,
    };
}

impl Observer for Callbacks {
    fn progress(&mut self, phase: Phase, fraction: f64) -> ControlFlow<()> {
        let Some(callback) = self.progress else { return ControlFlow::Continue(()) };
        // SAFETY: the caller set this function together with this pointer.
        match unsafe { callback(self.progress_data, DelotetPhase::from(phase), fraction) } {
            0 => ControlFlow::Continue(()),
            _ => ControlFlow::Break(()),
        }
    }

    fn log(&mut self, message: &str) {
        let Some(callback) = self.log else { return };
        // Without memory for a log line, the line is dropped.
        let Ok(text) = c_text(message) else { return };
        // SAFETY: the caller set this function together with this pointer; the text lives until it returns.
        unsafe { callback(self.log_data, text.as_ptr().cast()) }
    }
}

/// Runs `body` with the settings behind a handle that may be null (the defaults), under its limits and with its callbacks.
///
/// # Safety
/// `options` is null or valid.
pub(super) unsafe fn with_settings<R>(
    options: *const DelotetOptions,
    body: impl FnOnce(&Options, &Control) -> R,
) -> R {
    // SAFETY: the caller promises that a handle that is not null is valid.
    let handle = unsafe { options.as_ref() };
    let (options, mut callbacks, cancel) = match handle {
        Some(handle) => {
            (handle.options.copied(), handle.callbacks, handle.cancel.as_ref().map(Shared::share))
        }
        None => (Options::default(), Callbacks::NONE, None),
    };
    let size = callbacks.size;
    let background = handle.and_then(|handle| handle.background.as_ref());
    let wanted = |point| {
        let length = size.at(point)?;
        let most = background.map_or(f64::INFINITY, |background| background.at(point));
        // What is no length is the caller's, and refused.
        Ok(if length > most { most } else { length })
    };
    // Declared after the function that it refers to, so dropped before.
    let mut options = options;
    if size.is_set() || background.is_some() {
        // SAFETY: the function lives longer than this copy of the options, and what `body` returns does not refer to them.
        options.size_function = Some(unsafe { borrowed(&wanted) });
    }
    let limits = with_token(options.limits(), &cancel);
    controlled(limits, &mut callbacks, |control| body(&options, control))
}

/// New options with the defaults that the setters document. The caller owns them; free them with delotet_options_free(). NULL only if
/// memory ran out.
#[no_mangle]
#[must_use]
pub extern "C" fn delotet_options_new() -> *mut DelotetOptions {
    make(|| DelotetOptions {
        options: Options::default(),
        callbacks: Callbacks::NONE,
        cancel: None,
        background: None,
    })
}

/// Runs the body of a setter.
///
/// # Safety
/// `options` is null or valid, and nothing else uses it; `out_error` is null or valid for one write.
pub(super) unsafe fn change(
    options: *mut DelotetOptions,
    out_error: *mut *mut DelotetError,
    body: impl FnOnce(&mut DelotetOptions) -> Result<(), Error>,
) -> DelotetStatus {
    // SAFETY: the caller promises that a handle that is not null is valid and not shared, and so for `out_error`.
    unsafe { guard(out_error, || body(get_mut(options, "options")?)) }
}

/// Sets what is made: a DELOTET_MODE_ constant. Default: DELOTET_MODE_CONSTRAINED. Errors: INVALID_ARGUMENT (other values).
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_options_set_mode(
    options: *mut DelotetOptions,
    mode: DelotetMode,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, and NULL or a valid out-parameter.
    unsafe {
        change(options, out_error, |options| {
            options.options.mode = match mode {
                DELOTET_MODE_DELAUNAY => Mode::Delaunay,
                DELOTET_MODE_CONSTRAINED => Mode::Constrained,
                DELOTET_MODE_PRESERVE => Mode::Preserve,
                _ => return Err(invalid(format_args!("mode {mode} is not a DELOTET_MODE_ constant"))),
            };
            Ok(())
        })
    }
}

/// Sets what DELOTET_MODE_PRESERVE keeps: a DELOTET_PRESERVE_ constant; other modes ignore it. Default: DELOTET_PRESERVE_ALL.
/// Errors: INVALID_ARGUMENT (other values).
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_options_set_preserve(
    options: *mut DelotetOptions,
    preserve: DelotetPreserve,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, and NULL or a valid out-parameter.
    unsafe {
        change(options, out_error, |options| {
            options.options.preserve = match preserve {
                DELOTET_PRESERVE_ALL => Preserve::All,
                DELOTET_PRESERVE_OUTER => Preserve::Outer,
                _ => {
                    return Err(invalid(format_args!(
                        "preserve {preserve} is not a DELOTET_PRESERVE_ constant"
                    )))
                }
            };
            Ok(())
        })
    }
}

/// Keep every tetrahedron of the convex hull, holes and outside included (holes given by seeds are still carved).
/// Default: false. Errors: INVALID_ARGUMENT (NULL).
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_options_set_keep_hull(
    options: *mut DelotetOptions,
    keep_hull: bool,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, and NULL or a valid out-parameter.
    unsafe {
        change(options, out_error, |options| {
            options.options.keep_hull = keep_hull;
            Ok(())
        })
    }
}

/// Treat facets with equal markers that meet at more than `angle` degrees (90 to 180) as one smooth patch, and flip its triangles to be
/// Delaunay on the surface before meshing; delotet_mesh_facet_flips() lists the flips. 0, the default: off. Errors: INVALID_ARGUMENT.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_options_set_merge_facets(
    options: *mut DelotetOptions,
    angle: f64,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, and NULL or a valid out-parameter.
    unsafe {
        change(options, out_error, |options| {
            options.options.merge_facets = match angle {
                0.0 => None,
                90.0..=180.0 => Some(angle),
                _ => {
                    return Err(invalid(format_args!(
                        "merge_facets: {angle} is neither 0 nor from 90 to 180 degrees"
                    )));
                }
            };
            Ok(())
        })
    }
}

/// Look for self-intersections and all other defects before meshing. Default: true. Without it an invalid PLC may cause
/// DELOTET_STATUS_INTERNAL. Errors: INVALID_ARGUMENT (NULL).
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_options_set_validate(
    options: *mut DelotetOptions,
    validate: bool,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, and NULL or a valid out-parameter.
    unsafe {
        change(options, out_error, |options| {
            options.options.validate = validate;
            Ok(())
        })
    }
}

/// Sets how many defects an error lists at most, and how many warnings of each kind a mesh lists. Default: 1000. Errors: INVALID_ARGUMENT
/// (NULL).
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_options_set_max_defects(
    options: *mut DelotetOptions,
    max_defects: usize,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, and NULL or a valid out-parameter.
    unsafe {
        change(options, out_error, |options| {
            options.options.max_defects = max_defects;
            Ok(())
        })
    }
}

/// Sets the number of worker threads; 0: one per processor available to the process. The mesh is the same, bit for bit, for any number.
/// Default: 1.
/// Errors: INVALID_ARGUMENT (NULL).
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_options_set_threads(
    options: *mut DelotetOptions,
    threads: usize,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, and NULL or a valid out-parameter.
    unsafe {
        change(options, out_error, |options| {
            options.options.threads = threads;
            Ok(())
        })
    }
}

/// Fail with DELOTET_STATUS_STEINER_LIMIT if the mesh needs more Steiner points than this; those that DELOTET_MODE_PRESERVE removes again
/// count where it starts from the constrained Delaunay tetrahedralization. UINT64_MAX, the default: 100,000 plus 100 per segment, and no
/// limit on points of filling.
/// Errors: INVALID_ARGUMENT (NULL).
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_options_set_steiner_limit(
    options: *mut DelotetOptions,
    limit: u64,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, and NULL or a valid out-parameter.
    unsafe {
        change(options, out_error, |options| {
            options.options.steiner_limit = (limit != u64::MAX).then_some(limit);
            Ok(())
        })
    }
}

/// Return the mesh even if some Steiner points have no valid position in doubles, instead of failing with DELOTET_STATUS_ROUNDING.
/// delotet_mesh_crowded_points() lists these points; tetrahedra at them may be flat or inverted in doubles; delotet_mesh_steiner_points()
/// gives the exact mesh. Default: false. Errors: INVALID_ARGUMENT (NULL).
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_options_set_exact_form(
    options: *mut DelotetOptions,
    exact_form: bool,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, and NULL or a valid out-parameter.
    unsafe {
        change(options, out_error, |options| {
            options.options.exact_form = exact_form;
            Ok(())
        })
    }
}

/// Leave out points that belong to no tetrahedron: those that equal an earlier one, and those around which everything was carved. Input
/// points then have other indices in the mesh, which delotet_mesh_point_map() gives. Unmeshed subfaces and subsegments are not listed,
/// since their points are dropped; warnings about them remain. Default: false. Errors: INVALID_ARGUMENT (NULL).
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_options_set_drop_unmeshed_points(
    options: *mut DelotetOptions,
    drop_unmeshed_points: bool,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, and NULL or a valid out-parameter.
    unsafe {
        change(options, out_error, |options| {
            options.options.drop_unmeshed_points = drop_unmeshed_points;
            Ok(())
        })
    }
}

/// The points are already in a spatially coherent order: skip sorting. Default: false. Errors: INVALID_ARGUMENT (NULL).
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_options_set_points_sorted(
    options: *mut DelotetOptions,
    points_sorted: bool,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, and NULL or a valid out-parameter.
    unsafe {
        change(options, out_error, |options| {
            options.options.points_sorted = points_sorted;
            Ok(())
        })
    }
}

/// Sets the callback that receives progress; `user_data` is passed to it unchanged. NULL, the default: none.
/// Errors: INVALID_ARGUMENT (options is NULL).
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_options_set_progress(
    options: *mut DelotetOptions,
    callback: DelotetProgressFn,
    user_data: *mut c_void,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, and NULL or a valid out-parameter.
    unsafe {
        change(options, out_error, |options| {
            options.callbacks.progress = callback;
            options.callbacks.progress_data = user_data;
            Ok(())
        })
    }
}

/// Sets the callback that receives log lines; `user_data` is passed to it unchanged. NULL, the default: none. The library itself never
/// prints. Errors: INVALID_ARGUMENT (options is NULL).
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_options_set_log(
    options: *mut DelotetOptions,
    callback: DelotetLogFn,
    user_data: *mut c_void,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, and NULL or a valid out-parameter.
    unsafe {
        change(options, out_error, |options| {
            options.callbacks.log = callback;
            options.callbacks.log_data = user_data;
            Ok(())
        })
    }
}

/// The settings of a handle, the defaults for NULL.
///
/// # Safety
/// `options` is null or valid.
pub(super) unsafe fn setting<R>(options: *const DelotetOptions, body: impl FnOnce(&Options) -> R) -> R {
    // SAFETY: the caller promises that a handle that is not null is valid.
    match unsafe { options.as_ref() } {
        Some(options) => body(&options.options),
        None => body(&Options::default()),
    }
}

/// The mode, as set by delotet_options_set_mode(). All getters return the default for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_options_mode(options: *const DelotetOptions) -> DelotetMode {
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile.
    unsafe {
        setting(options, |options| match options.mode {
            Mode::Delaunay => DELOTET_MODE_DELAUNAY,
            Mode::Constrained => DELOTET_MODE_CONSTRAINED,
            Mode::Preserve => DELOTET_MODE_PRESERVE,
        })
    }
}

/// What DELOTET_MODE_PRESERVE keeps, as set by delotet_options_set_preserve().
#[no_mangle]
pub unsafe extern "C" fn delotet_options_preserve(options: *const DelotetOptions) -> DelotetPreserve {
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile.
    unsafe {
        setting(options, |options| match options.preserve {
            Preserve::All => DELOTET_PRESERVE_ALL,
            Preserve::Outer => DELOTET_PRESERVE_OUTER,
        })
    }
}

/// Whether the convex hull is kept, as set by delotet_options_set_keep_hull().
#[no_mangle]
pub unsafe extern "C" fn delotet_options_keep_hull(options: *const DelotetOptions) -> bool {
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile.
    unsafe { setting(options, |options| options.keep_hull) }
}

/// The angle of facet merging in degrees, 0 if it is off, as set by delotet_options_set_merge_facets().
#[no_mangle]
pub unsafe extern "C" fn delotet_options_merge_facets(options: *const DelotetOptions) -> f64 {
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile.
    unsafe { setting(options, |options| options.merge_facets.unwrap_or(0.0)) }
}

/// Whether the input is validated, as set by delotet_options_set_validate().
#[no_mangle]
pub unsafe extern "C" fn delotet_options_validate(options: *const DelotetOptions) -> bool {
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile.
    unsafe { setting(options, |options| options.validate) }
}

/// How many defects an error lists at most, as set by delotet_options_set_max_defects().
#[no_mangle]
pub unsafe extern "C" fn delotet_options_max_defects(options: *const DelotetOptions) -> usize {
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile.
    unsafe { setting(options, |options| options.max_defects) }
}

/// The number of worker threads, as set by delotet_options_set_threads().
#[no_mangle]
pub unsafe extern "C" fn delotet_options_threads(options: *const DelotetOptions) -> usize {
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile.
    unsafe { setting(options, |options| options.threads) }
}

/// The limit on Steiner points, UINT64_MAX for the default limit, as set by delotet_options_set_steiner_limit().
#[no_mangle]
pub unsafe extern "C" fn delotet_options_steiner_limit(options: *const DelotetOptions) -> u64 {
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile.
    unsafe { setting(options, |options| options.steiner_limit.unwrap_or(u64::MAX)) }
}

/// Whether a mesh without valid double coordinates is returned, as set by delotet_options_set_exact_form().
#[no_mangle]
pub unsafe extern "C" fn delotet_options_exact_form(options: *const DelotetOptions) -> bool {
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile.
    unsafe { setting(options, |options| options.exact_form) }
}

/// Whether points that belong to no tetrahedron are left out, as set by delotet_options_set_drop_unmeshed_points().
#[no_mangle]
pub unsafe extern "C" fn delotet_options_drop_unmeshed_points(options: *const DelotetOptions) -> bool {
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile.
    unsafe { setting(options, |options| options.drop_unmeshed_points) }
}

/// Whether sorting is skipped, as set by delotet_options_set_points_sorted().
#[no_mangle]
pub unsafe extern "C" fn delotet_options_points_sorted(options: *const DelotetOptions) -> bool {
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile.
    unsafe { setting(options, |options| options.points_sorted) }
}

/// The progress callback, NULL if there is none, as set by delotet_options_set_progress().
/// `out_user_data`: NULL, or receives the pointer that was set with it (NULL without a callback).
#[no_mangle]
pub unsafe extern "C" fn delotet_options_progress(
    options: *const DelotetOptions,
    out_user_data: *mut *mut c_void,
) -> DelotetProgressFn {
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile, and NULL or a valid out-parameter.
    unsafe {
        let callbacks = read(options, Callbacks::NONE, |options| options.callbacks);
        put(out_user_data, callbacks.progress_data);
        callbacks.progress
    }
}

/// The log callback, NULL if there is none, as set by delotet_options_set_log().
/// `out_user_data`: NULL, or receives the pointer that was set with it (NULL without a callback).
#[no_mangle]
pub unsafe extern "C" fn delotet_options_log(
    options: *const DelotetOptions,
    out_user_data: *mut *mut c_void,
) -> DelotetLogFn {
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile, and NULL or a valid out-parameter.
    unsafe {
        let callbacks = read(options, Callbacks::NONE, |options| options.callbacks);
        put(out_user_data, callbacks.log_data);
        callbacks.log
    }
}

/// Writes `value` through `pointer`, unless that is null.
///
/// # Safety
/// `pointer` is null or valid for one write.
pub(super) unsafe fn put(pointer: *mut *mut c_void, value: *mut c_void) {
    if !pointer.is_null() {
        // SAFETY: not null, and the caller promises that it is valid for a write.
        unsafe { pointer.write(value) };
    }
}

/// Frees options. NULL is ignored. No run may be using them.
#[no_mangle]
pub unsafe extern "C" fn delotet_options_free(options: *mut DelotetOptions) {
    // SAFETY: the caller passes NULL or options that it owns.
    unsafe { free(options) }
}
