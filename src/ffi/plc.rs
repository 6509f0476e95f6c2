//! The input: a PLC that grows by calls. Arrays are copied.
use super::error::DelotetError;
use super::guard::{free, get, get_mut, guard, invalid, read, Out};
use super::options::{settings, DelotetOptions};
use super::slice::{array, optional};
use super::status::DelotetStatus;
use super::view::{DelotetDoublesView, DelotetMarkersView, DelotetPointsView};
use crate::error::{Defect, DefectKind, Element, Error, Status};
use crate::plc::{Facet, Interior, Plc, RegionSeed, Segment};
use crate::INVALID;

/// A piecewise linear complex: points, segments, facets, hole seeds and region seeds. Indices of points, segments and facets
/// are 0-based, in the order of addition.
pub struct DelotetPlc {
    pub(super) plc: Plc,
}

impl DelotetPlc {
    /// The first corner that refers to no point, as an error.
    fn check_corners(&self, corners: &[u32], element: impl Fn(usize) -> Element) -> Result<(), Error> {
        let points = self.plc.points.len();
        match corners.iter().position(|&corner| corner as usize >= points) {
            None => Ok(()),
            Some(place) => Err(Error::with_defect(
                Status::IndexOutOfRange,
                format!("point {} does not exist: the PLC has {points} points", corners[place]),
                Defect {
                    kind: DefectKind::IndexOutOfRange,
                    first: element(place),
                    second: Some(Element::Point(corners[place])),
                    point: None,
                },
            )),
        }
    }

    fn check_room(&self, count: usize, present: usize) -> Result<(), Error> {
        match present.checked_add(count).is_some_and(|sum| sum < INVALID as usize) {
            true => Ok(()),
            false => Err(Error::new(Status::TooLarge, "more elements than 32-bit indices can address")),
        }
    }

    fn add_segments(&mut self, ends: &[u32], markers: Option<&[i32]>) -> Result<(), Error> {
        let first = self.plc.segments.len();
        self.check_room(ends.len() / 2, first)?;
        self.check_corners(ends, |place| Element::Segment((first + place / 2) as u32))?;
        self.plc.segments.try_reserve(ends.len() / 2)?;
        for (index, pair) in ends.chunks_exact(2).enumerate() {
            let marker = markers.map_or(0, |markers| markers[index]);
            self.plc.segments.push(Segment { ends: [pair[0], pair[1]], marker });
        }
        Ok(())
    }

    /// Triangles stay in their compact list while no general facet precedes them: facets keep the order of addition.
    fn add_triangles(&mut self, corners: &[u32], markers: Option<&[i32]>) -> Result<(), Error> {
        let (first, count) = (self.plc.facet_count(), corners.len() / 3);
        self.check_room(count, first)?;
        self.check_corners(corners, |place| Element::Facet((first + place / 3) as u32))?;
        if !self.plc.facets.is_empty() {
            let ends: Vec<usize> = (1..=count).map(|end| 3 * end).collect();
            return self.add_polygons(corners, &ends, markers);
        }
        self.plc.triangles.try_reserve(count)?;
        let marked = markers.is_some() || !self.plc.triangle_markers.is_empty();
        if marked {
            self.plc.triangle_markers.try_reserve(first + count - self.plc.triangle_markers.len())?;
            self.plc.triangle_markers.resize(first, 0);
        }
        self.plc.triangles.extend(corners.chunks_exact(3).map(|corner| [corner[0], corner[1], corner[2]]));
        match markers {
            Some(markers) => self.plc.triangle_markers.extend_from_slice(markers),
            None if marked => self.plc.triangle_markers.resize(first + count, 0),
            None => {}
        }
        Ok(())
    }

    /// One facet per polygon.
    fn add_polygons(
        &mut self,
        corners: &[u32],
        ends: &[usize],
        markers: Option<&[i32]>,
    ) -> Result<(), Error> {
        let first = self.plc.facet_count();
        self.check_room(ends.len(), first)?;
        self.check_corners(corners, |place| {
            Element::Facet((first + ends.partition_point(|&end| end <= place)) as u32)
        })?;
        self.plc.facets.try_reserve(ends.len())?;
        let mut start = 0;
        for (index, &end) in ends.iter().enumerate() {
            let polygons = split(&corners[start..], &[end - start])?;
            start = end;
            let marker = markers.map_or(0, |markers| markers[index]);
            self.plc.facets.push(Facet { polygons, marker, ..Facet::default() });
        }
        Ok(())
    }

    fn add_facet(&mut self, corners: &[u32], ends: &[usize], facet: Facet) -> Result<(), Error> {
        let index = self.plc.facet_count();
        self.check_room(1, index)?;
        self.check_corners(corners, |_| Element::Facet(index as u32))?;
        let polygons = split(corners, ends)?;
        self.plc.facets.try_reserve(1)?;
        self.plc.facets.push(Facet { polygons, ..facet });
        Ok(())
    }
}

/// Cuts the corner list of a facet into its polygons.
fn split(corners: &[u32], ends: &[usize]) -> Result<Vec<Vec<u32>>, Error> {
    let mut polygons = Vec::new();
    polygons.try_reserve_exact(ends.len())?;
    let mut start = 0;
    for &end in ends {
        let mut polygon = Vec::new();
        polygon.try_reserve_exact(end - start)?;
        polygon.extend_from_slice(&corners[start..end]);
        polygons.push(polygon);
        start = end;
    }
    Ok(polygons)
}

/// The corner list that belongs to a list of ends, which must ascend.
///
/// # Safety
/// `corners` is valid for as many elements as the last of `ends` says.
unsafe fn corner_list<'a>(corners: *const u32, ends: &[usize]) -> Result<&'a [u32], Error> {
    if ends.first().is_some_and(|&end| end == 0) || ends.windows(2).any(|pair| pair[0] >= pair[1]) {
        return Err(invalid("the ends of the polygons do not ascend: every polygon needs a corner"));
    }
    // SAFETY: the caller promises the length.
    unsafe { array(corners, ends.last().copied().unwrap_or(0), "corners") }
}

/// `count` rows of `width`, or an error if that overflows.
fn times(count: usize, width: usize) -> Result<usize, Error> {
    count.checked_mul(width).ok_or_else(|| invalid("the count does not fit into memory"))
}

fn copied<T: Copy>(list: &[T]) -> Result<Vec<T>, Error> {
    let mut copy = Vec::new();
    copy.try_reserve_exact(list.len())?;
    copy.extend_from_slice(list);
    Ok(copy)
}

/// A new PLC with these points and nothing else.
/// `xyz`: #points by 3 doubles, x y z per point; copied; may be NULL if `point_count` is 0. Finiteness is checked later, by
/// delotet_plc_check and delotet_tetrahedralize.
/// `out_plc`: the PLC, owned by the caller: free with delotet_plc_free; NULL on failure.
/// `out_error`: may be NULL; NULL on success, else an error to be freed with delotet_error_free. So for all functions here.
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
            let mut handle = DelotetPlc { plc: Plc::default() };
            handle.check_room(point_count, 0)?;
            handle.plc.points = copied(points)?;
            out.put(handle);
            Ok(())
        })
    }
}

/// Sets the attributes of all points (replacing earlier ones): fields that are carried to the mesh, linear at Steiner points.
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
            plc.point_attributes = copied(list)?;
            plc.point_attribute_count = attribute_count;
            Ok(())
        })
    }
}

/// Sets the markers of all points (replacing earlier ones).
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
            plc.point_markers = copied(optional(markers, plc.points.len(), "markers")?.unwrap_or(&[]))?;
            Ok(())
        })
    }
}

/// Adds a segment from point `a` to point `b`. Edges of facets need not be given, unless they carry a marker.
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
/// `corners`: #triangles by 3 point indices; copied. `markers`: #triangles integers, or NULL (all 0). The order of the corners
/// is free. Coplanar neighbours with equal markers are meshed as one: the edge between them need not be an edge of the mesh, unless
/// it is a segment, too.
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
/// has the corners from polygon_ends[i - 1] (0 for the first) up to, not including, polygon_ends[i]. Copied.
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

/// Adds one planar facet with holes: the first ring is its outer boundary, all others (three corners or more) are holes in it.
/// Rings of one or two corners are points and edges inside the facet that the mesh has to respect.
/// `corners`: the corner indices of all rings, one after the other; `ring_ends`: #rings ascending positions, as for
/// delotet_plc_add_polygons. Copied.
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

/// Adds one planar facet by TetGen's rule: what cannot be reached from outside without crossing an edge of a polygon belongs to
/// the facet, except what can be reached from a hole seed. Inner polygons and polygons of two corners constrain only.
/// `corners`, `polygon_ends`: as for delotet_plc_add_facet. `hole_seeds`: #holes by 3 doubles, one point in each hole; copied;
/// may be NULL if `hole_count` is 0.
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
            let (holes, interior) = (copied(seeds)?, Interior::Seeds);
            get_mut(plc, "plc")?.add_facet(corners, ends, Facet { polygons: vec![], holes, interior, marker })
        })
    }
}

/// Adds a hole: what can be reached from the point `seed` (x y z) without crossing a facet is not meshed.
/// Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. That the seed lies inside is checked later.
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
            let holes = &mut get_mut(plc, "plc")?.plc.holes;
            holes.try_reserve(1)?;
            holes.push(seed);
            Ok(())
        })
    }
}

/// Adds a region: the tetrahedra that can be reached from the point `seed` (x y z) without crossing a facet get `attribute`.
/// `max_volume`: largest volume of a tetrahedron there, carried to delotet_mesh_regions; not positive: none.
/// Errors: INVALID_ARGUMENT (also a NaN), OUT_OF_MEMORY. That the seed lies inside is checked later.
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
            let regions = &mut get_mut(plc, "plc")?.plc.regions;
            regions.try_reserve(1)?;
            let max_volume = (max_volume > 0.0).then_some(max_volume);
            regions.push(RegionSeed { point, attribute, max_volume });
            Ok(())
        })
    }
}

/// Looks for defects: non-finite points, elements without extent, self-intersections, unusable polygons. All of them are listed
/// in the error, up to the maximum of `options`, which may be NULL (the defaults); progress is reported and may cancel. A surface that
/// encloses nothing fails too, with its open edges, unless `options` keep the hull or ask for DELOTET_MODE_DELAUNAY; where other parts
/// enclose something, the log gets a warning.
/// Errors: INVALID_ARGUMENT, the statuses from 10 to 29, CANCELLED, OUT_OF_MEMORY.
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
            let (options, mut callbacks) = settings(options);
            crate::plc::check(&get(plc, "plc")?.plc, &options, &mut callbacks)?.log(&mut callbacks);
            Ok(())
        })
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

/// The markers of the points: one each, or none at all. Borrowed from `plc`: valid until it is changed or freed. Empty for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_plc_point_markers(plc: *const DelotetPlc) -> DelotetMarkersView {
    // SAFETY: the caller passes NULL or a PLC that nothing changes meanwhile.
    unsafe { read(plc, DelotetMarkersView::new(&[]), |plc| DelotetMarkersView::new(&plc.plc.point_markers)) }
}

/// How many segments. 0 for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_plc_segment_count(plc: *const DelotetPlc) -> usize {
    // SAFETY: the caller passes NULL or a PLC that nothing changes meanwhile.
    unsafe { read(plc, 0, |plc| plc.plc.segments.len()) }
}

/// How many facets: triangles and others. 0 for NULL.
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

/// Frees a PLC and all that was borrowed from it. NULL is ignored. Meshes made from it live on.
#[no_mangle]
pub unsafe extern "C" fn delotet_plc_free(plc: *mut DelotetPlc) {
    // SAFETY: the caller passes NULL or a PLC that it owns.
    unsafe { free(plc) }
}
