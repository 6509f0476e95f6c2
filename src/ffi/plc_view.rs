//! Reading the input back: views of the contents of a PLC.
use crate::ffi::guard::read;
use crate::ffi::plc::DelotetPlc;
use crate::ffi::view::*;
use crate::plc::{Facet, Interior, Plc};
use libc::c_char;

/// How the rings of a facet bound it: one of the DELOTET_FACET_RULE_ constants.
pub type DelotetFacetRule = u32;
/// The first ring is the outer boundary, the others are holes in it (delotet_plc_add_facet(), and all facets of one ring).
pub const DELOTET_FACET_RULE_RINGS: DelotetFacetRule = 0;
/// TetGen's rule: hole seeds mark the holes (delotet_plc_add_facet_with_hole_seeds()).
pub const DELOTET_FACET_RULE_SEEDS: DelotetFacetRule = 1;

/// A facet found by its index: a triangle or a general facet.
enum Found<'a> {
    Triangle(&'a [u32; 3]),
    General(&'a Facet),
}

fn facet_of(plc: &Plc, facet: u32) -> Option<Found<'_>> {
    match (facet as usize).checked_sub(plc.triangles.len()) {
        None => plc.triangles.get(facet as usize).map(Found::Triangle),
        Some(general) => plc.facets.get(general).map(Found::General),
    }
}

fn ring_of(plc: &Plc, facet: u32, ring: usize) -> &[u32] {
    match facet_of(plc, facet) {
        Some(Found::Triangle(corners)) if ring == 0 => corners,
        Some(Found::General(facet)) => facet.polygons.get(ring).map_or(&[], |ring| ring),
        _ => &[],
    }
}

/// The points: #points by 3 doubles. Borrowed from `plc`: valid until it is changed or freed. Empty for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_plc_points(plc: *const DelotetPlc) -> DelotetPointsView {
    // SAFETY: the caller passes NULL or a PLC that nothing changes meanwhile.
    unsafe { read(plc, DelotetPointsView::new(&[]), |plc| DelotetPointsView::new(&plc.plc.points)) }
}

/// The attributes of the points: #points by `width` doubles. Borrowed from `plc`: valid until it is changed or freed. Empty for
/// NULL and without attributes.
#[no_mangle]
pub unsafe extern "C" fn delotet_plc_point_attributes(plc: *const DelotetPlc) -> DelotetDoublesView {
    let view = |list: &[f64], width| DelotetDoublesView::new(list, width);
    // SAFETY: the caller passes NULL or a PLC that nothing changes meanwhile.
    unsafe { read(plc, view(&[], 0), |plc| view(&plc.plc.point_attributes, plc.plc.point_attribute_count)) }
}

/// The markers of the points: one per point, or none at all. Borrowed from `plc`: valid until it is changed or freed. Empty for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_plc_point_markers(plc: *const DelotetPlc) -> DelotetMarkersView {
    // SAFETY: the caller passes NULL or a PLC that nothing changes meanwhile.
    unsafe { read(plc, DelotetMarkersView::new(&[]), |plc| DelotetMarkersView::new(&plc.plc.point_markers)) }
}

/// The number of segments. 0 for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_plc_segment_count(plc: *const DelotetPlc) -> usize {
    // SAFETY: the caller passes NULL or a PLC that nothing changes meanwhile.
    unsafe { read(plc, 0, |plc| plc.plc.segments.len()) }
}

/// The number of facets, triangles and others. 0 for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_plc_facet_count(plc: *const DelotetPlc) -> usize {
    // SAFETY: the caller passes NULL or a PLC that nothing changes meanwhile.
    unsafe { read(plc, 0, |plc| plc.plc.facet_count()) }
}

/// The marker of a facet; 0 for NULL and for facets that do not exist.
#[no_mangle]
pub unsafe extern "C" fn delotet_plc_facet_marker(plc: *const DelotetPlc, facet: u32) -> i32 {
    let marker = |plc: &Plc| match (facet as usize) < plc.facet_count() {
        true => plc.facet_marker(facet as usize),
        false => 0,
    };
    // SAFETY: the caller passes NULL or a PLC that nothing changes meanwhile.
    unsafe { read(plc, 0, |plc| marker(&plc.plc)) }
}

/// The segments. Borrowed from `plc`: valid until it is changed or freed. Empty for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_plc_segments(plc: *const DelotetPlc) -> DelotetSegmentsView {
    // SAFETY: the caller passes NULL or a PLC that nothing changes meanwhile.
    unsafe { read(plc, DelotetSegmentsView::new(&[]), |plc| DelotetSegmentsView::new(&plc.plc.segments)) }
}

/// The hole seeds: #holes by 3 doubles. Borrowed from `plc`: valid until it is changed or freed. Empty for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_plc_holes(plc: *const DelotetPlc) -> DelotetPointsView {
    // SAFETY: the caller passes NULL or a PLC that nothing changes meanwhile.
    unsafe { read(plc, DelotetPointsView::new(&[]), |plc| DelotetPointsView::new(&plc.plc.holes)) }
}

/// The region seeds. Borrowed from `plc`: valid until it is changed or freed. Empty for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_plc_regions(plc: *const DelotetPlc) -> DelotetRegionSeedsView {
    // SAFETY: the caller passes NULL or a PLC that nothing changes meanwhile.
    unsafe { read(plc, DelotetRegionSeedsView::new(&[]), |plc| DelotetRegionSeedsView::new(&plc.seeds)) }
}

/// The triangles that come first among the facets: #triangles by 3 indices, facets 0 to #triangles - 1. They end at the first facet that
/// was not added as a triangle; delotet_plc_facet_ring() works for every facet. Borrowed from `plc`: valid until it is changed or freed.
/// Empty for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_plc_triangles(plc: *const DelotetPlc) -> DelotetIndexRowsView {
    let none = DelotetIndexRowsView::new::<3>(&[]);
    // SAFETY: the caller passes NULL or a PLC that nothing changes meanwhile.
    unsafe { read(plc, none, |plc| DelotetIndexRowsView::new(&plc.plc.triangles)) }
}

/// The number of rings (polygons) of a facet: 1 for triangles. 0 for NULL and for facets that do not exist.
#[no_mangle]
pub unsafe extern "C" fn delotet_plc_facet_ring_count(plc: *const DelotetPlc, facet: u32) -> usize {
    let count = |plc: &Plc| match facet_of(plc, facet) {
        None => 0,
        Some(Found::Triangle(_)) => 1,
        Some(Found::General(facet)) => facet.polygons.len(),
    };
    // SAFETY: the caller passes NULL or a PLC that nothing changes meanwhile.
    unsafe { read(plc, 0, |plc| count(&plc.plc)) }
}

/// The corners of a ring of a facet, in the order given. Borrowed from `plc`: valid until it is changed or freed. Empty for NULL and for
/// rings that do not exist.
#[no_mangle]
pub unsafe extern "C" fn delotet_plc_facet_ring(
    plc: *const DelotetPlc,
    facet: u32,
    ring: usize,
) -> DelotetIndicesView {
    let view = |plc: &DelotetPlc| DelotetIndicesView::new(ring_of(&plc.plc, facet, ring));
    // SAFETY: the caller passes NULL or a PLC that nothing changes meanwhile.
    unsafe { read(plc, DelotetIndicesView::new(&[]), view) }
}

/// How the rings of a facet bound it. DELOTET_FACET_RULE_RINGS for NULL and for facets that do not exist.
#[no_mangle]
pub unsafe extern "C" fn delotet_plc_facet_rule(plc: *const DelotetPlc, facet: u32) -> DelotetFacetRule {
    let rule = |plc: &DelotetPlc| match facet_of(&plc.plc, facet) {
        Some(Found::General(Facet { interior: Interior::Seeds, .. })) => DELOTET_FACET_RULE_SEEDS,
        _ => DELOTET_FACET_RULE_RINGS,
    };
    // SAFETY: the caller passes NULL or a PLC that nothing changes meanwhile.
    unsafe { read(plc, DELOTET_FACET_RULE_RINGS, rule) }
}

/// The points in the holes of a facet: #holes by 3 doubles. Borrowed from `plc`: valid until it is changed or freed. Empty for NULL,
/// for facets that do not exist, and for facets without such seeds.
#[no_mangle]
pub unsafe extern "C" fn delotet_plc_facet_hole_seeds(
    plc: *const DelotetPlc,
    facet: u32,
) -> DelotetPointsView {
    let seeds = |plc: &DelotetPlc| match facet_of(&plc.plc, facet) {
        Some(Found::General(facet)) => DelotetPointsView::new(&facet.holes),
        _ => DelotetPointsView::new(&[]),
    };
    // SAFETY: the caller passes NULL or a PLC that nothing changes meanwhile.
    unsafe { read(plc, DelotetPointsView::new(&[]), seeds) }
}

/// The number of facet markers with names: from the groups, solids, materials or colours of a file, or set by
/// delotet_plc_set_marker_name(). 0 for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_plc_marker_name_count(plc: *const DelotetPlc) -> usize {
    // SAFETY: the caller passes NULL or a PLC that nothing changes meanwhile.
    unsafe { read(plc, 0, |plc| plc.names.len()) }
}

/// The name of a facet marker, UTF-8, zero-terminated; NULL if it has none or `plc` is NULL. Borrowed from `plc`: valid until it is changed
/// or freed.
#[no_mangle]
pub unsafe extern "C" fn delotet_plc_marker_name(plc: *const DelotetPlc, marker: i32) -> *const c_char {
    let name = |plc: &DelotetPlc| match plc.plc.names.binary_search_by_key(&marker, |name| name.marker) {
        Ok(at) => plc.names.get(at).map_or(std::ptr::null(), |name| name.as_ptr().cast()),
        Err(_) => std::ptr::null(),
    };
    // SAFETY: the caller passes NULL or a PLC that nothing changes meanwhile.
    unsafe { read(plc, std::ptr::null(), name) }
}

/// The marker with index `index` among those with names, in ascending order. 0 for NULL and if `index` is not below
/// delotet_plc_marker_name_count().
#[no_mangle]
pub unsafe extern "C" fn delotet_plc_named_marker(plc: *const DelotetPlc, index: usize) -> i32 {
    let marker = |plc: &DelotetPlc| plc.plc.names.get(index).map_or(0, |name| name.marker);
    // SAFETY: the caller passes NULL or a PLC that nothing changes meanwhile.
    unsafe { read(plc, 0, marker) }
}
