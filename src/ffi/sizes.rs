//! Points by size and shape: the options, the caller's size function, and sizes of parts of the input.
use crate::error::{Error, Status};
use crate::ffi::error::DelotetError;
use crate::ffi::guard::{get_mut, guard, invalid, read};
use crate::ffi::mesh::DelotetMesh;
use crate::ffi::options::{change, put, setting, DelotetOptions};
use crate::ffi::plc::DelotetPlc;
use crate::ffi::slice::array;
use crate::ffi::status::DelotetStatus;
use crate::ffi::view::DelotetDoublesView;
use crate::options::{Options, SizeFunction};
use crate::plc::Plc;
use crate::query::Background;
use libc::c_void;
use std::fmt::Display;

/// Gives the edge length wanted at a point. `point`: its x y z, valid only during the callback. `size`: receives the length, positive or
/// infinite; infinite, which it is before the call, is no wish. Return 0 to continue, anything else to cancel: the call then fails with
/// DELOTET_STATUS_CANCELLED; NaN, zero and negative lengths end it with DELOTET_STATUS_INVALID_ARGUMENT. Called on the thread that made
/// the call, once or more for a point, in the same order in every run. The same point must always get the same length: otherwise the mesh
/// is another one in every run. Must not throw, must not longjmp, and must not use the handles of the call.
pub type DelotetSizeFunction =
    Option<unsafe extern "C" fn(user_data: *mut c_void, point: *const f64, size: *mut f64) -> i32>;

/// The caller's size function.
#[derive(Clone, Copy)]
pub(super) struct SizeCallback {
    function: DelotetSizeFunction,
    data: *mut c_void,
}

// SAFETY: the pointers are only handed back to the caller's own function; the header tells the caller that runs on several threads with
// the same options call it from all these threads.
unsafe impl Send for SizeCallback {}
// SAFETY: as above; nothing here is changed through a shared reference.
unsafe impl Sync for SizeCallback {}

impl SizeCallback {
    /// No function.
    pub(super) const NONE: SizeCallback = SizeCallback { function: None, data: std::ptr::null_mut() };

    pub(super) fn is_set(&self) -> bool {
        self.function.is_some()
    }

    /// What the function says.
    pub(super) fn at(&self, point: [f64; 3]) -> Result<f64, Error> {
        let mut size = f64::INFINITY;
        let Some(function) = self.function else { return Ok(size) };
        // SAFETY: the caller set this function together with this pointer; point and size live until it returns.
        match unsafe { function(self.data, point.as_ptr(), &mut size) } {
            0 => Ok(size),
            _ => Err(Error::new(Status::Cancelled, "cancelled by the size function")),
        }
    }
}

/// A function on the stack as the options keep it.
///
/// # Safety
/// The result and its copies are used only as long as `function` lives.
pub(super) unsafe fn borrowed(
    function: &(dyn Fn([f64; 3]) -> Result<f64, Error> + Send + Sync),
) -> SizeFunction {
    type Function<'a> = dyn Fn([f64; 3]) -> Result<f64, Error> + Send + Sync + 'a;
    // SAFETY: only lifetimes change; the caller promises that what the function refers to lives long enough.
    SizeFunction::borrowed(unsafe {
        std::mem::transmute::<&Function<'_>, &'static Function<'static>>(function)
    })
}

/// A setting that 0 turns off: positive and finite, at least `least`.
fn positive(value: f64, least: f64, name: &str, what: impl Display) -> Result<Option<f64>, Error> {
    if value == 0.0 {
        return Ok(None);
    }
    if value > 0.0 && value >= least && value.is_finite() {
        return Ok(Some(value));
    }
    Err(invalid(format_args!("{name}: {value} is neither 0 nor {what}")))
}

/// Sets the largest edge length wanted anywhere, in the units of the coordinates: the mesh is filled with points. The smallest of all sizes
/// counts: this one, those of the input (delotet_plc_set_point_sizes() and so on), that of the size function, and what follows from the
/// lengths of the surface and the gradation. In DELOTET_MODE_CONSTRAINED the surface is refined too: points come on segments, exactly on
/// facets, and inside. In DELOTET_MODE_PRESERVE they come only inside. In DELOTET_MODE_DELAUNAY delotet_tetrahedralize() fails with
/// INVALID_ARGUMENT. 0, the default: off. Errors: INVALID_ARGUMENT (negative or not finite).
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_options_set_size(
    options: *mut DelotetOptions,
    size: f64,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, and NULL or a valid out-parameter.
    unsafe {
        change(options, out_error, |options| {
            options.options.size = positive(size, 0.0, "size", "a positive finite length")?;
            Ok(())
        })
    }
}

/// The largest edge length wanted inside, 0 if there is none, as set by delotet_options_set_size().
#[no_mangle]
pub unsafe extern "C" fn delotet_options_size(options: *const DelotetOptions) -> f64 {
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile.
    unsafe { setting(options, |options| options.size.unwrap_or(0.0)) }
}

/// Sets the largest volume of a tetrahedron, in cubed units of the coordinates: the mesh is filled with points until none is above it where
/// the surface allows that. The bounds of regions (delotet_plc_add_region()) count beside it once the mesh is filled. Modes as for
/// delotet_options_set_size(). 0, the default: off. Errors: INVALID_ARGUMENT (negative or not finite).
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_options_set_max_volume(
    options: *mut DelotetOptions,
    volume: f64,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, and NULL or a valid out-parameter.
    unsafe {
        change(options, out_error, |options| {
            options.options.max_volume = positive(volume, 0.0, "max_volume", "a positive finite volume")?;
            Ok(())
        })
    }
}

/// The largest volume of a tetrahedron, 0 if there is no bound, as set by delotet_options_set_max_volume().
#[no_mangle]
pub unsafe extern "C" fn delotet_options_max_volume(options: *const DelotetOptions) -> f64 {
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile.
    unsafe { setting(options, |options| options.max_volume.unwrap_or(0.0)) }
}

/// Sets how fast sizes may grow: by at most this many times the distance. More than 0, at most 1. Has an effect only where the mesh is
/// filled. Default: 0.3. Errors: INVALID_ARGUMENT (other values).
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_options_set_gradation(
    options: *mut DelotetOptions,
    gradation: f64,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, and NULL or a valid out-parameter.
    unsafe {
        change(options, out_error, |options| {
            if !(gradation > 0.0 && gradation <= 1.0) {
                return Err(invalid(format_args!("gradation: {gradation} is not above 0 and at most 1")));
            }
            options.options.gradation = gradation;
            Ok(())
        })
    }
}

/// How fast sizes may grow, as set by delotet_options_set_gradation().
#[no_mangle]
pub unsafe extern "C" fn delotet_options_gradation(options: *const DelotetOptions) -> f64 {
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile.
    unsafe { setting(options, |options| options.gradation) }
}

/// Fill the mesh with points until no tetrahedron's circumradius is more than `ratio` times its shortest edge, where the surface allows
/// that. Without other sizes those of the surface count, and grow inwards by the gradation. The number of points is bounded: at small
/// angles, in needles and in thin plates tetrahedra stay bad. At least 1; 1.4 to 2 are good values. Modes as for delotet_options_set_size().
/// 0, the default: off. Errors: INVALID_ARGUMENT (other values below 1, or not finite).
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_options_set_quality(
    options: *mut DelotetOptions,
    ratio: f64,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, and NULL or a valid out-parameter.
    unsafe {
        change(options, out_error, |options| {
            let least = Options::LEAST_RATIO;
            options.options.quality =
                positive(ratio, least, "quality", format_args!("a finite ratio of at least {least}"))?;
            Ok(())
        })
    }
}

/// The largest radius-edge ratio wanted, 0 if there is no bound, as set by delotet_options_set_quality().
#[no_mangle]
pub unsafe extern "C" fn delotet_options_quality(options: *const DelotetOptions) -> f64 {
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile.
    unsafe { setting(options, |options| options.quality.unwrap_or(0.0)) }
}

/// Sets the effort to optimise the smallest dihedral angles: 0, the default, is none, 1 is as much as pays, larger numbers take longer and
/// find more. Modes as for delotet_options_set_size(). In DELOTET_MODE_CONSTRAINED facets and segments are then unions of faces and edges, but
/// the mesh need not be Delaunay; together with delotet_options_set_exact_form() delotet_tetrahedralize() fails there with INVALID_ARGUMENT.
/// Errors: INVALID_ARGUMENT (NULL).
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_options_set_optimize(
    options: *mut DelotetOptions,
    effort: u32,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, and NULL or a valid out-parameter.
    unsafe {
        change(options, out_error, |options| {
            options.options.optimize = effort;
            Ok(())
        })
    }
}

/// The effort of optimisation, as set by delotet_options_set_optimize().
#[no_mangle]
pub unsafe extern "C" fn delotet_options_optimize(options: *const DelotetOptions) -> u32 {
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile.
    unsafe { setting(options, |options| options.optimize) }
}

/// Optimise for so many seconds instead of by an effort, as with the largest effort: until nothing is gained any more, or the time is over. What
/// the mesh is then is the result, which so depends on the machine and its load. They count from the beginning of the optimisation; limits
/// (delotet_options_set_time_limit()) still end the call. Otherwise as delotet_options_set_optimize(). 0, the default: the effort counts.
/// Errors: INVALID_ARGUMENT (negative or not finite).
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_options_set_optimize_seconds(
    options: *mut DelotetOptions,
    seconds: f64,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, and NULL or a valid out-parameter.
    unsafe {
        change(options, out_error, |options| {
            let what = "a positive finite number of seconds";
            options.options.optimize_seconds = positive(seconds, 0.0, "optimize_seconds", what)?;
            Ok(())
        })
    }
}

/// The seconds of optimisation, 0 if the effort counts, as set by delotet_options_set_optimize_seconds().
#[no_mangle]
pub unsafe extern "C" fn delotet_options_optimize_seconds(options: *const DelotetOptions) -> f64 {
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile.
    unsafe { setting(options, |options| options.optimize_seconds.unwrap_or(0.0)) }
}

/// Sets the smallest dihedral angle that is wanted, in degrees: what is below it after the optimisation, or above 180 less it, is worked on
/// further; if it is not reached, larger efforts of up to 3 are tried from the start, and the best counts. Angles of the input bound what can be reached. At most 60. Otherwise as
/// delotet_options_set_optimize(). 0, the default: none. Errors: INVALID_ARGUMENT (negative, above 60, not finite).
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_options_set_min_angle(
    options: *mut DelotetOptions,
    degrees: f64,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, and NULL or a valid out-parameter.
    unsafe {
        change(options, out_error, |options| {
            let most = Options::LARGEST_MIN_ANGLE;
            let angle =
                positive(degrees, 0.0, "min_angle", format_args!("an angle of at most {most} degrees"))?;
            if angle.is_some_and(|angle| angle > most) {
                return Err(invalid(format_args!("min_angle: {degrees} is above {most} degrees")));
            }
            options.options.min_angle = angle;
            Ok(())
        })
    }
}

/// The smallest dihedral angle wanted, in degrees, 0 if there is none, as set by delotet_options_set_min_angle().
#[no_mangle]
pub unsafe extern "C" fn delotet_options_min_angle(options: *const DelotetOptions) -> f64 {
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile.
    unsafe { setting(options, |options| options.min_angle.unwrap_or(0.0)) }
}

/// Sets the function that gives the edge length wanted at a point; `user_data` is passed to it unchanged. It is one size among the others:
/// see delotet_options_set_size(), also for modes. NULL, the default: none. Errors: INVALID_ARGUMENT (options is NULL).
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_options_set_size_function(
    options: *mut DelotetOptions,
    function: DelotetSizeFunction,
    user_data: *mut c_void,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, and NULL or a valid out-parameter.
    unsafe {
        change(options, out_error, |options| {
            options.callbacks.size = SizeCallback { function, data: user_data };
            Ok(())
        })
    }
}

/// The size function, NULL if there is none, as set by delotet_options_set_size_function().
/// `out_user_data`: NULL, or receives the pointer that was set with it (NULL without a function).
#[no_mangle]
pub unsafe extern "C" fn delotet_options_size_function(
    options: *const DelotetOptions,
    out_user_data: *mut *mut c_void,
) -> DelotetSizeFunction {
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile, and NULL or a valid out-parameter.
    unsafe {
        let size = read(options, SizeCallback::NONE, |options| options.callbacks.size);
        put(out_user_data, size.data);
        size.function
    }
}

/// Sets a background mesh: the edge length wanted at a place inside of it is linear between the sizes at the corners of its tetrahedron there;
/// outside there is no wish. It fills, as the size function does: see delotet_options_set_size(), also for modes; beside a size function the
/// smaller one counts.
/// `mesh`: any mesh, NULL removes the background. Copied, as far as needed: it may be freed at once. `sizes`: one per point of the mesh,
/// positive, infinite for no wish in the tetrahedra there; copied; may be NULL if `mesh` is. `count`: the number of points of the mesh.
/// Errors: INVALID_ARGUMENT (the message names the point), OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_options_set_background(
    options: *mut DelotetOptions,
    mesh: *const DelotetMesh,
    sizes: *const f64,
    count: usize,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, NULL or a mesh that is alive, an array of that size, and NULL or a
    // valid out-parameter.
    unsafe {
        change(options, out_error, |options| {
            options.background = match mesh.as_ref() {
                Some(mesh) => Some(Background::new(&mesh.mesh, array(sizes, count, "sizes")?)?),
                None => None,
            };
            Ok(())
        })
    }
}

/// The sizes at the points of the background mesh, as set by delotet_options_set_background(): #points by 1 double. Borrowed from `options`:
/// valid until they get another one or are freed. Empty without one, and for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_options_background(options: *const DelotetOptions) -> DelotetDoublesView {
    let view = |list: &[f64]| DelotetDoublesView::new(list, 1);
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile.
    unsafe {
        read(options, view(&[]), |options| {
            view(options.background.as_ref().map_or(&[][..], Background::sizes))
        })
    }
}

/// Sets the edge length wanted at each point, replacing earlier ones; points that are added later have none.
/// `sizes`: one per point, positive, infinite where there is no wish; copied; may be NULL if `count` is 0. `count`: the number of points, or
/// 0, which removes all. Sizes are wishes for filling (delotet_options_set_size()): by themselves they fill nothing. Errors:
/// INVALID_ARGUMENT, OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_plc_set_point_sizes(
    plc: *mut DelotetPlc,
    sizes: *const f64,
    count: usize,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a PLC that nothing else uses and an array of that size.
    unsafe {
        guard(out_error, || {
            let plc = get_mut(plc, "plc")?;
            plc.set_point_sizes(array(sizes, count, "sizes")?)
        })
    }
}

/// The sizes of the points: #points by 1 double, or none at all. Borrowed from `plc`: valid until it is changed or freed. Empty for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_plc_point_sizes(plc: *const DelotetPlc) -> DelotetDoublesView {
    let view = |list: &[f64]| DelotetDoublesView::new(list, 1);
    // SAFETY: the caller passes NULL or a PLC that nothing changes meanwhile.
    unsafe { read(plc, view(&[]), |plc| view(&plc.plc.sizes.points)) }
}

/// Sets the edge length wanted at the facets with a marker, replacing an earlier one. `size`: positive; infinite removes it. As a wish for
/// filling: see delotet_plc_set_point_sizes(). Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_plc_set_facet_size(
    plc: *mut DelotetPlc,
    marker: i32,
    size: f64,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a PLC that nothing else uses.
    unsafe { guard(out_error, || get_mut(plc, "plc")?.plc.sizes.set_facets(marker, size)) }
}

/// The edge length wanted at the facets with a marker; infinite if there is none, and for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_plc_facet_size(plc: *const DelotetPlc, marker: i32) -> f64 {
    // SAFETY: the caller passes NULL or a PLC that nothing changes meanwhile.
    unsafe { read(plc, f64::INFINITY, |plc| or_none(plc.plc.sizes.of_facet(marker))) }
}

/// Sets the largest area wanted of a subface of the facets with a marker, in squared units of the coordinates, replacing an earlier one. As a
/// length it is the edge of the equilateral triangle of this area; of length and area the smaller counts. Where the surface is refined
/// (DELOTET_MODE_CONSTRAINED), subfaces are split until none is above it; only segments that are close to each other for their length, and so in
/// each other's way, may keep some larger. `area`: positive; infinite removes it. As a wish for filling: see
/// delotet_plc_set_point_sizes(). Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_plc_set_facet_area(
    plc: *mut DelotetPlc,
    marker: i32,
    area: f64,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a PLC that nothing else uses.
    unsafe { guard(out_error, || get_mut(plc, "plc")?.plc.sizes.set_facet_areas(marker, area)) }
}

/// The largest area wanted at the facets with a marker; infinite if there is none, and for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_plc_facet_area(plc: *const DelotetPlc, marker: i32) -> f64 {
    // SAFETY: the caller passes NULL or a PLC that nothing changes meanwhile.
    unsafe { read(plc, f64::INFINITY, |plc| or_none(plc.plc.sizes.area_of_facet(marker))) }
}

/// Sets the edge length wanted at the segments with a marker; otherwise as delotet_plc_set_facet_size().
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_plc_set_segment_size(
    plc: *mut DelotetPlc,
    marker: i32,
    size: f64,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a PLC that nothing else uses.
    unsafe { guard(out_error, || get_mut(plc, "plc")?.plc.sizes.set_segments(marker, size)) }
}

/// The edge length wanted at the segments with a marker; infinite if there is none, and for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_plc_segment_size(plc: *const DelotetPlc, marker: i32) -> f64 {
    // SAFETY: the caller passes NULL or a PLC that nothing changes meanwhile.
    unsafe { read(plc, f64::INFINITY, |plc| or_none(plc.plc.sizes.of_segment(marker))) }
}

/// Sets the edge length wanted in the regions with an attribute (delotet_plc_add_region()); otherwise as delotet_plc_set_facet_size().
/// Errors: INVALID_ARGUMENT (also for an attribute that is NaN), OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_plc_set_region_size(
    plc: *mut DelotetPlc,
    attribute: f64,
    size: f64,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a PLC that nothing else uses.
    unsafe { guard(out_error, || get_mut(plc, "plc")?.plc.sizes.set_regions(attribute, size)) }
}

/// The edge length wanted in the regions with an attribute; infinite if there is none, and for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_plc_region_size(plc: *const DelotetPlc, attribute: f64) -> f64 {
    // SAFETY: the caller passes NULL or a PLC that nothing changes meanwhile.
    unsafe { read(plc, f64::INFINITY, |plc| of_region(&plc.plc, attribute)) }
}

/// A length as C sees it.
fn or_none(size: Option<f64>) -> f64 {
    size.unwrap_or(f64::INFINITY)
}

fn of_region(plc: &Plc, attribute: f64) -> f64 {
    or_none(plc.sizes.regions.iter().find(|s| s.attribute == attribute).map(|s| s.size))
}
