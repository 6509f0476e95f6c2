//! The input: a PLC built by calls. Arrays are copied.
use crate::error::Error;
use crate::fallible;
use crate::ffi::error::DelotetError;
use crate::ffi::guard::{free, get, get_mut, guard, invalid, set, Out};
use crate::ffi::options::{with_settings, DelotetOptions};
use crate::ffi::plc_edit::times;
use crate::ffi::slice::{array, optional};
use crate::ffi::status::DelotetStatus;
use crate::ffi::view::DelotetRegionSeed;
use crate::plc::{check_with, Facet, Interior, Plc, RegionSeed};
use libc::c_char;
use std::ffi::CStr;

/// A piecewise linear complex: points, segments, facets, hole seeds and region seeds. Indices of points, segments and facets
/// are 0-based, in the order of addition.
pub struct DelotetPlc {
    pub(super) plc: Plc,
    /// The region seeds as C sees them.
    pub(super) seeds: Vec<DelotetRegionSeed>,
    /// The names of facet markers as C sees them, in the order of the PLC's.
    pub(super) names: Vec<Vec<u8>>,
}

/// The corner list for a list of polygon ends. Fails if the ends do not ascend.
///
/// # Safety
/// `corners` is valid for as many elements as the last of `ends` says.
unsafe fn corner_list<'a>(corners: *const u32, ends: &[usize]) -> Result<&'a [u32], Error> {
    if ends.first().is_some_and(|&end| end == 0) || ends.windows(2).any(|pair| pair[0] >= pair[1]) {
        return Err(invalid("the ends of the polygons must ascend: every polygon needs a corner"));
    }
    // SAFETY: the caller promises the length.
    unsafe { array(corners, ends.last().copied().unwrap_or(0), "corners") }
}

/// Creates a PLC with these points and nothing else.
/// `xyz`: #points by 3 doubles, x y z per point; copied; may be NULL if `point_count` is 0. Finiteness is checked later, by
/// delotet_plc_check() and delotet_tetrahedralize().
/// `out_plc`: the PLC, owned by the caller; free it with delotet_plc_free(). NULL on failure.
/// `out_error`: may be NULL; receives NULL on success, otherwise an error to be freed with delotet_error_free(). The same holds for all
/// functions here.
/// Errors: INVALID_ARGUMENT, TOO_LARGE (2^32 - 1 points or more), OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_plc_new(
    xyz: *const f64,
    point_count: usize,
    out_plc: *mut *mut DelotetPlc,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes an array of that size, and NULL or valid out-parameters.
    unsafe {
        guard(out_error, || {
            let out = Out::new(out_plc, "out_plc")?;
            let points = array(xyz.cast::<[f64; 3]>(), point_count, "xyz")?;
            let mut handle = DelotetPlc::new(Plc::default())?;
            handle.add_points(points)?;
            out.put(handle)
        })
    }
}

/// Copies a PLC with everything in it.
/// `out_plc`: the copy, owned by the caller; free it with delotet_plc_free(). NULL on failure. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_plc_clone(
    plc: *const DelotetPlc,
    out_plc: *mut *mut DelotetPlc,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a PLC that nothing changes meanwhile, and NULL or valid out-parameters.
    unsafe {
        guard(out_error, || {
            let out = Out::new(out_plc, "out_plc")?;
            out.put(DelotetPlc::new(get(plc, "plc")?.plc.try_clone()?)?)
        })
    }
}

/// Appends points. Their attributes and markers are 0, if the points have any.
/// `xyz`: #points by 3 doubles; copied. `out_first`: NULL, or receives the index of the first new point (the others follow).
/// Errors: INVALID_ARGUMENT, TOO_LARGE, OUT_OF_MEMORY; then nothing was added.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_plc_add_points(
    plc: *mut DelotetPlc,
    xyz: *const f64,
    count: usize,
    out_first: *mut u32,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a PLC that nothing else uses, an array of that size, and NULL or valid out-parameters.
    unsafe {
        guard(out_error, || {
            let plc = get_mut(plc, "plc")?;
            let first = plc.plc.points.len() as u32;
            plc.add_points(array(xyz.cast::<[f64; 3]>(), count, "xyz")?)?;
            if out_first.is_null() {
                return Ok(());
            }
            set(out_first, first, "out_first")
        })
    }
}

/// Sets the attributes of all points, replacing earlier ones. They are passed on to the mesh, and interpolated linearly at Steiner points.
/// `attributes`: #points by `attribute_count` doubles; copied. `attribute_count` 0 removes them.
/// Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_plc_set_point_attributes(
    plc: *mut DelotetPlc,
    attributes: *const f64,
    attribute_count: usize,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a PLC that nothing else uses and an array of that size.
    unsafe {
        guard(out_error, || {
            let plc = &mut get_mut(plc, "plc")?.plc;
            let list = array(attributes, times(plc.points.len(), attribute_count)?, "attributes")?;
            plc.point_attributes = fallible::copied(list)?;
            plc.point_attribute_count = attribute_count;
            Ok(())
        })
    }
}

/// Sets the markers of all points, replacing earlier ones.
/// `markers`: #points integers; copied; NULL removes them. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_plc_set_point_markers(
    plc: *mut DelotetPlc,
    markers: *const i32,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a PLC that nothing else uses and an array of that size.
    unsafe {
        guard(out_error, || {
            let plc = &mut get_mut(plc, "plc")?.plc;
            plc.point_markers =
                fallible::copied(optional(markers, plc.points.len(), "markers")?.unwrap_or(&[]))?;
            Ok(())
        })
    }
}

/// Sets the markers of all segments, replacing earlier ones.
/// `markers`: #segments integers; copied; NULL sets all to 0. Errors: INVALID_ARGUMENT.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_plc_set_segment_markers(
    plc: *mut DelotetPlc,
    markers: *const i32,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a PLC that nothing else uses and an array of that size.
    unsafe {
        guard(out_error, || {
            let segments = &mut get_mut(plc, "plc")?.plc.segments;
            let markers = optional(markers, segments.len(), "markers")?;
            for (index, segment) in segments.iter_mut().enumerate() {
                segment.marker = markers.map_or(0, |markers| markers[index]);
            }
            Ok(())
        })
    }
}

/// Sets the markers of all facets, replacing earlier ones.
/// `markers`: #facets integers; copied; NULL sets all to 0. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_plc_set_facet_markers(
    plc: *mut DelotetPlc,
    markers: *const i32,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a PLC that nothing else uses and an array of that size.
    unsafe {
        guard(out_error, || {
            let plc = get_mut(plc, "plc")?;
            plc.set_facet_markers(optional(markers, plc.plc.facet_count(), "markers")?)
        })
    }
}

/// Sets the marker of one facet. Errors: INVALID_ARGUMENT, INDEX_OUT_OF_RANGE, OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_plc_set_facet_marker(
    plc: *mut DelotetPlc,
    facet: u32,
    marker: i32,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a PLC that nothing else uses.
    unsafe { guard(out_error, || get_mut(plc, "plc")?.set_facet_marker(facet, marker)) }
}

/// Names a facet marker; files use such names for groups. `name`: UTF-8, zero-terminated; its first line is copied; NULL or "" removes the
/// name. Errors: INVALID_ARGUMENT (also if `name` is not UTF-8), OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_plc_set_marker_name(
    plc: *mut DelotetPlc,
    marker: i32,
    name: *const c_char,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a PLC that nothing else uses, and NULL or a zero-terminated text.
    unsafe {
        guard(out_error, || {
            let plc = get_mut(plc, "plc")?;
            let name = if name.is_null() { c"" } else { CStr::from_ptr(name) };
            plc.set_marker_name(marker, name.to_str().map_err(|_| invalid("name is not UTF-8"))?)
        })
    }
}

/// Adds a segment from point `a` to point `b`. Facet edges need not be added, unless they carry a marker.
/// Errors: INVALID_ARGUMENT, INDEX_OUT_OF_RANGE, TOO_LARGE, OUT_OF_MEMORY; then nothing was added.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_plc_add_segment(
    plc: *mut DelotetPlc,
    a: u32,
    b: u32,
    marker: i32,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a PLC that nothing else uses.
    unsafe { guard(out_error, || get_mut(plc, "plc")?.add_segments(&[a, b], Some(&[marker]))) }
}

/// Adds `count` segments.
/// `ends`: #segments by 2 point indices; copied. `markers`: #segments integers, or NULL (all 0).
/// Errors: INVALID_ARGUMENT, INDEX_OUT_OF_RANGE, TOO_LARGE, OUT_OF_MEMORY; then nothing was added.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_plc_add_segments(
    plc: *mut DelotetPlc,
    ends: *const u32,
    markers: *const i32,
    count: usize,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a PLC that nothing else uses and arrays of these sizes.
    unsafe {
        guard(out_error, || {
            let ends = array(ends, times(count, 2)?, "ends")?;
            get_mut(plc, "plc")?.add_segments(ends, optional(markers, count, "markers")?)
        })
    }
}

/// Adds `count` triangular facets.
/// `corners`: #triangles by 3 point indices; copied. `markers`: #triangles integers, or NULL (all 0). Corners may be in either order.
/// Coplanar neighbours with equal markers are meshed as one facet: the edge between them need not be an edge of the mesh, unless it is also
/// a segment.
/// Errors: INVALID_ARGUMENT, INDEX_OUT_OF_RANGE, TOO_LARGE, OUT_OF_MEMORY; then nothing was added.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_plc_add_triangles(
    plc: *mut DelotetPlc,
    corners: *const u32,
    markers: *const i32,
    count: usize,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a PLC that nothing else uses and arrays of these sizes.
    unsafe {
        guard(out_error, || {
            let corners = array(corners, times(count, 3)?, "corners")?;
            get_mut(plc, "plc")?.add_triangles(corners, optional(markers, count, "markers")?)
        })
    }
}

/// Adds `count` facets of one polygon each (quadrilaterals, any planar polygon).
/// `corners`: the corner indices of all polygons, one after the other; `polygon_ends`: #polygons ascending positions: polygon i
/// has the corners from `polygon_ends[i - 1]` (0 for the first) up to, not including, `polygon_ends[i]`. Copied.
/// `markers`: #polygons integers, or NULL (all 0).
/// Errors: INVALID_ARGUMENT, INDEX_OUT_OF_RANGE, TOO_LARGE, OUT_OF_MEMORY; then nothing was added.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_plc_add_polygons(
    plc: *mut DelotetPlc,
    corners: *const u32,
    polygon_ends: *const usize,
    markers: *const i32,
    count: usize,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a PLC that nothing else uses and arrays of these sizes.
    unsafe {
        guard(out_error, || {
            let ends = array(polygon_ends, count, "polygon_ends")?;
            let corners = corner_list(corners, ends)?;
            get_mut(plc, "plc")?.add_polygons(corners, ends, optional(markers, count, "markers")?)
        })
    }
}

/// Adds one planar facet with holes: the first ring is its outer boundary, all others (three corners or more) are holes in it. Rings of one
/// or two corners are points and edges in the facet that the mesh must contain.
/// `corners`: the corner indices of all rings, one after the other; `ring_ends`: #rings ascending positions, as for
/// delotet_plc_add_polygons(). Copied.
/// Errors: INVALID_ARGUMENT, INDEX_OUT_OF_RANGE, TOO_LARGE, OUT_OF_MEMORY; then nothing was added.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_plc_add_facet(
    plc: *mut DelotetPlc,
    corners: *const u32,
    ring_ends: *const usize,
    ring_count: usize,
    marker: i32,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a PLC that nothing else uses and arrays of these sizes.
    unsafe {
        guard(out_error, || {
            let ends = array(ring_ends, ring_count, "ring_ends")?;
            let corners = corner_list(corners, ends)?;
            get_mut(plc, "plc")?.add_facet(corners, ends, Facet { marker, ..Facet::default() })
        })
    }
}

/// Adds one planar facet by TetGen's rule: the facet is what cannot be reached from outside without crossing a polygon's edge, except what
/// can be reached from a hole seed. Inner polygons and polygons of two corners only constrain the mesh.
/// `corners`, `polygon_ends`: as for delotet_plc_add_facet(). `hole_seeds`: #holes by 3 doubles, one point in each hole; copied; may be
/// NULL if `hole_count` is 0.
/// Errors: INVALID_ARGUMENT, INDEX_OUT_OF_RANGE, TOO_LARGE, OUT_OF_MEMORY; then nothing was added.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_plc_add_facet_with_hole_seeds(
    plc: *mut DelotetPlc,
    corners: *const u32,
    polygon_ends: *const usize,
    polygon_count: usize,
    hole_seeds: *const f64,
    hole_count: usize,
    marker: i32,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a PLC that nothing else uses and arrays of these sizes.
    unsafe {
        guard(out_error, || {
            let ends = array(polygon_ends, polygon_count, "polygon_ends")?;
            let corners = corner_list(corners, ends)?;
            let seeds = array(hole_seeds.cast::<[f64; 3]>(), hole_count, "hole_seeds")?;
            let (holes, interior) = (fallible::copied(seeds)?, Interior::Seeds);
            get_mut(plc, "plc")?.add_facet(
                corners,
                ends,
                Facet { polygons: Vec::new(), holes, interior, marker },
            )
        })
    }
}

/// Adds a hole: everything reachable from the point `seed` (x y z) without crossing a facet is left unmeshed.
/// Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. Whether the seed lies inside is checked later.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_plc_add_hole(
    plc: *mut DelotetPlc,
    seed: *const f64,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a PLC that nothing else uses and three doubles.
    unsafe {
        guard(out_error, || {
            let seed = array(seed.cast::<[f64; 3]>(), 1, "seed")?[0];
            Ok(fallible::push(&mut get_mut(plc, "plc")?.plc.holes, seed)?)
        })
    }
}

/// Adds a region: the tetrahedra reachable from the point `seed` (x y z) without crossing a facet get `attribute`. `max_volume`: bound on
/// the volume of a tetrahedron there, kept once the mesh is filled (delotet_options_set_quality() and others); none if it is not positive.
/// Errors: INVALID_ARGUMENT (NULL or NaN), OUT_OF_MEMORY. Whether the seed lies inside is checked later.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_plc_add_region(
    plc: *mut DelotetPlc,
    seed: *const f64,
    attribute: f64,
    max_volume: f64,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a PLC that nothing else uses and three doubles.
    unsafe {
        guard(out_error, || {
            let point = array(seed.cast::<[f64; 3]>(), 1, "seed")?[0];
            if attribute.is_nan() || max_volume.is_nan() {
                return Err(invalid("attribute or max_volume is not a number"));
            }
            let max_volume = (max_volume > 0.0).then_some(max_volume);
            get_mut(plc, "plc")?.add_region(RegionSeed { point, attribute, max_volume })
        })
    }
}

/// Looks for defects: non-finite points, elements without extent, self-intersections, unusable polygons. The error lists all of them, up to
/// the maximum of `options`, which may be NULL (the defaults). The callbacks of `options` receive progress and may cancel. A surface that
/// encloses nothing fails too, with its open edges listed, unless `options` keep the hull or ask for DELOTET_MODE_DELAUNAY; if only part of
/// the surface encloses nothing, the log gets a warning.
/// Errors: INVALID_ARGUMENT, the statuses from 10 to 29, CANCELLED, TIME_LIMIT, MEMORY_LIMIT, OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_plc_check(
    plc: *const DelotetPlc,
    options: *const DelotetOptions,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes handles that nothing changes meanwhile.
    unsafe {
        guard(out_error, || {
            let plc = &get(plc, "plc")?.plc;
            with_settings(options, |options, control| {
                check_with(plc, options, control)?.log(control);
                Ok(())
            })
        })
    }
}

/// Frees a PLC and everything borrowed from it. NULL is ignored. Meshes made from it stay valid.
#[no_mangle]
pub unsafe extern "C" fn delotet_plc_free(plc: *mut DelotetPlc) {
    // SAFETY: the caller passes NULL or a PLC that it owns.
    unsafe { free(plc) }
}
