//! The result: views of the arrays that the engine made. Derived arrays are in `query`.
use crate::error::Error;
use crate::fallible;
use crate::ffi::error::DelotetError;
use crate::ffi::guard::{free, get, guard, invalid, null, read};
use crate::ffi::plc::DelotetPlc;
use crate::ffi::status::DelotetStatus;
use crate::ffi::view::*;
use crate::ffi::warning::DelotetWarning;
use crate::output::TetMesh;
use crate::plc::Plc;
use crate::progress::Phase;
use crate::query::{Edges, Faces, ForcedTet, Locator, PointData, QualitySummary, TetQuality};
use std::sync::OnceLock;

/// A tetrahedral mesh: immutable, so any number of threads may read it.
pub struct DelotetMesh {
    pub(super) mesh: TetMesh,
    pub(super) data: PointData,
    regions: Vec<DelotetRegion>,
    pub(super) warnings: Vec<DelotetWarning>,
    peak_resident: u64,
    pub(super) derived: Derived,
}

/// What is derived from the mesh, on first use.
#[derive(Default)]
pub(super) struct Derived {
    pub(super) faces: OnceLock<Faces>,
    pub(super) edges: OnceLock<Edges>,
    pub(super) point_tets: OnceLock<Vec<u32>>,
    pub(super) tet_attributes: OnceLock<Vec<f64>>,
    pub(super) nodes: OnceLock<Vec<[f64; 3]>>,
    pub(super) tets10: [OnceLock<Vec<[u32; 10]>>; 3],
    pub(super) locator: OnceLock<Locator>,
    pub(super) tet_qualities: OnceLock<Vec<TetQuality>>,
    pub(super) forced_tets: OnceLock<Vec<ForcedTet>>,
    pub(super) quality_summary: OnceLock<QualitySummary>,
}

/// Handles may be passed between threads, and const ones shared.
const _: () = {
    const fn shareable<T: Send + Sync>() {}
    shareable::<DelotetMesh>();
    shareable::<DelotetPlc>();
    shareable::<super::options::DelotetOptions>();
    shareable::<DelotetStats>();
};

impl DelotetMesh {
    /// A handle for a finished mesh.
    pub(super) fn new(mesh: TetMesh, data: PointData) -> Result<DelotetMesh, Error> {
        let regions = fallible::collect(mesh.regions.iter().map(|region| DelotetRegion {
            attribute: region.attribute,
            max_volume: region.max_volume.unwrap_or(0.0),
            seed: region.seed,
        }))?;
        let warnings = fallible::collect(mesh.warnings.list().iter().map(DelotetWarning::from))?;
        let peak_resident = super::memory::peak_resident().unwrap_or(0);
        Ok(DelotetMesh { mesh, data, regions, warnings, peak_resident, derived: Derived::default() })
    }
}

/// All points: the input points first, bit for bit and in input order, then the Steiner points. Borrowed from `mesh`: valid until
/// it is freed, as all views of a mesh are. Empty for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_mesh_points(mesh: *const DelotetMesh) -> DelotetPointsView {
    // SAFETY: the caller passes NULL or a mesh that is alive.
    unsafe { read(mesh, DelotetPointsView::new(&[]), |mesh| DelotetPointsView::new(&mesh.mesh.points)) }
}

/// The number of points that are input points. 0 for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_mesh_input_point_count(mesh: *const DelotetMesh) -> usize {
    // SAFETY: the caller passes NULL or a mesh that is alive.
    unsafe { read(mesh, 0, |mesh| mesh.mesh.input_point_count as usize) }
}

/// For each input point the first input point with the same coordinates (itself if there is no earlier one): tetrahedra use only that one.
/// Borrowed from `mesh`. Empty for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_mesh_point_aliases(mesh: *const DelotetMesh) -> DelotetIndicesView {
    // SAFETY: the caller passes NULL or a mesh that is alive.
    unsafe {
        read(mesh, DelotetIndicesView::new(&[]), |mesh| DelotetIndicesView::new(&mesh.mesh.point_alias))
    }
}

/// Where the input points are in a mesh made with delotet_options_set_drop_unmeshed_points(): for each input point its index in
/// delotet_mesh_points(), or the index of the earlier point that it equals; DELOTET_INVALID_INDEX if it was left out. Borrowed from `mesh`.
/// Empty for NULL and without that option: points then keep their indices.
#[no_mangle]
pub unsafe extern "C" fn delotet_mesh_point_map(mesh: *const DelotetMesh) -> DelotetIndicesView {
    let none = DelotetIndicesView::new(&[]);
    let inputs = |mesh: &DelotetMesh| {
        mesh.mesh.dropped.as_ref().map(|dropped| DelotetIndicesView::new(dropped.inputs()))
    };
    // SAFETY: the caller passes NULL or a mesh that is alive.
    unsafe { read(mesh, none, |mesh| inputs(mesh).unwrap_or(none)) }
}

/// Points without a valid position in doubles: empty unless delotet_options_set_exact_form() was on and rounding failed.
/// Borrowed from `mesh`. Empty for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_mesh_crowded_points(mesh: *const DelotetMesh) -> DelotetIndicesView {
    // SAFETY: the caller passes NULL or a mesh that is alive.
    unsafe { read(mesh, DelotetIndicesView::new(&[]), |mesh| DelotetIndicesView::new(&mesh.mesh.crowded)) }
}

/// Tetrahedra that replace ones for which no double coordinates gave a positive volume, in ascending order: nearly flat facets force them.
/// They are positive, but not necessarily Delaunay. Where sheets are too close for Steiner points on the surface in doubles, the mesh has
/// no such points, and these are all tetrahedra at faces that are not locally Delaunay. Borrowed from `mesh`. Empty for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_mesh_replaced_tets(mesh: *const DelotetMesh) -> DelotetIndicesView {
    // SAFETY: the caller passes NULL or a mesh that is alive.
    unsafe { read(mesh, DelotetIndicesView::new(&[]), |mesh| DelotetIndicesView::new(&mesh.mesh.replaced)) }
}

/// Attributes of all points: #points by `width` doubles. Input points have the input's; Steiner points on an input edge are interpolated
/// linearly between its ends, those inside linearly in a tetrahedron of surrounding points.
/// Borrowed from `mesh`. Empty for NULL and if the input has none.
#[no_mangle]
pub unsafe extern "C" fn delotet_mesh_point_attributes(mesh: *const DelotetMesh) -> DelotetDoublesView {
    let view = |data: &PointData| DelotetDoublesView::new(&data.attributes, data.attribute_count);
    // SAFETY: the caller passes NULL or a mesh that is alive.
    unsafe { read(mesh, DelotetDoublesView::new(&[], 0), |mesh| view(&mesh.data)) }
}

/// Markers of all points. Input points have the input's; Steiner points have that of their segment, or 0 if they lie on no segment.
/// Borrowed from `mesh`. Empty for NULL and if the input has none.
#[no_mangle]
pub unsafe extern "C" fn delotet_mesh_point_markers(mesh: *const DelotetMesh) -> DelotetMarkersView {
    // SAFETY: the caller passes NULL or a mesh that is alive.
    unsafe { read(mesh, DelotetMarkersView::new(&[]), |mesh| DelotetMarkersView::new(&mesh.data.markers)) }
}

/// The tetrahedra: four corners each, positively oriented, det(b - a, c - a, d - a) > 0, as in VTK, Gmsh and TetGen's output. Borrowed from
/// `mesh`. Empty for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_mesh_tets(mesh: *const DelotetMesh) -> DelotetTetsView {
    // SAFETY: the caller passes NULL or a mesh that is alive.
    unsafe { read(mesh, DelotetTetsView::new(&[]), |mesh| DelotetTetsView::new(&mesh.mesh.tets)) }
}

/// The neighbours: for each tetrahedron and corner i the tetrahedron across the face opposite that corner, or DELOTET_INVALID_INDEX if
/// there is none. Borrowed from `mesh`. Empty for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_mesh_neighbors(mesh: *const DelotetMesh) -> DelotetTetsView {
    // SAFETY: the caller passes NULL or a mesh that is alive.
    unsafe { read(mesh, DelotetTetsView::new(&[]), |mesh| DelotetTetsView::new(&mesh.mesh.neighbors)) }
}

/// For each tetrahedron the index of its region in delotet_mesh_regions(). Borrowed from `mesh`. Empty for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_mesh_tet_regions(mesh: *const DelotetMesh) -> DelotetIndicesView {
    // SAFETY: the caller passes NULL or a mesh that is alive.
    unsafe { read(mesh, DelotetIndicesView::new(&[]), |mesh| DelotetIndicesView::new(&mesh.mesh.tet_region)) }
}

/// The regions. Borrowed from `mesh`. Empty for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_mesh_regions(mesh: *const DelotetMesh) -> DelotetRegionsView {
    // SAFETY: the caller passes NULL or a mesh that is alive.
    unsafe { read(mesh, DelotetRegionsView::new(&[]), |mesh| DelotetRegionsView::new(&mesh.regions)) }
}

/// The faces on facets, with facet, marker and both tetrahedra. Pieces of facets that bound no tetrahedron are in
/// delotet_mesh_unmeshed_subfaces(). Borrowed from `mesh`. Empty for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_mesh_subfaces(mesh: *const DelotetMesh) -> DelotetSubfacesView {
    // SAFETY: the caller passes NULL or a mesh that is alive.
    unsafe { read(mesh, DelotetSubfacesView::new(&[]), |mesh| DelotetSubfacesView::new(&mesh.mesh.subfaces)) }
}

/// The mesh edges on segments and on facet edges, with segment and marker. Borrowed from `mesh`. Empty for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_mesh_subsegments(mesh: *const DelotetMesh) -> DelotetSubsegmentsView {
    let none = DelotetSubsegmentsView::new(&[]);
    // SAFETY: the caller passes NULL or a mesh that is alive.
    unsafe { read(mesh, none, |mesh| DelotetSubsegmentsView::new(&mesh.mesh.subsegments)) }
}

/// Pieces of facets that bound no tetrahedron because everything around them was carved: a shell that leaks, a facet outside the domain, a
/// wall in a hole. They are not faces of the mesh: both tetrahedra are DELOTET_INVALID_INDEX. Borrowed from `mesh`. Empty for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_mesh_unmeshed_subfaces(mesh: *const DelotetMesh) -> DelotetSubfacesView {
    let none = DelotetSubfacesView::new(&[]);
    // SAFETY: the caller passes NULL or a mesh that is alive.
    unsafe { read(mesh, none, |mesh| DelotetSubfacesView::new(&mesh.mesh.unmeshed_subfaces)) }
}

/// Pieces of segments and of facet edges that are edges of no tetrahedron. Borrowed from `mesh`. Empty for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_mesh_unmeshed_subsegments(
    mesh: *const DelotetMesh,
) -> DelotetSubsegmentsView {
    let none = DelotetSubsegmentsView::new(&[]);
    // SAFETY: the caller passes NULL or a mesh that is alive.
    unsafe { read(mesh, none, |mesh| DelotetSubsegmentsView::new(&mesh.mesh.unmeshed_subsegments)) }
}

/// Points that belong to no tetrahedron, in ascending order: those that equal an earlier point (delotet_mesh_point_aliases()), those
/// around which everything was carved, and those that weights hide (delotet_mesh_hidden_points()). Borrowed from `mesh`. Empty for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_mesh_unmeshed_points(mesh: *const DelotetMesh) -> DelotetIndicesView {
    let none = DelotetIndicesView::new(&[]);
    // SAFETY: the caller passes NULL or a mesh that is alive.
    unsafe { read(mesh, none, |mesh| DelotetIndicesView::new(&mesh.mesh.unmeshed_points)) }
}

/// The Steiner points, in the order of delotet_mesh_points(), with the input edge and the segment that each lies on, if any. Borrowed from
/// `mesh`. Empty for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_mesh_steiner_points(mesh: *const DelotetMesh) -> DelotetSteinerView {
    // SAFETY: the caller passes NULL or a mesh that is alive.
    unsafe { read(mesh, DelotetSteinerView::new(&[]), |mesh| DelotetSteinerView::new(&mesh.mesh.steiner)) }
}

/// Further terms of parameters that one double cannot hold (segments about an ulp apart), in the order of the Steiner points, each point's
/// largest term first. Borrowed from `mesh`. Empty for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_mesh_steiner_terms(mesh: *const DelotetMesh) -> DelotetSteinerTermsView {
    let none = DelotetSteinerTermsView::new(&[]);
    // SAFETY: the caller passes NULL or a mesh that is alive.
    unsafe { read(mesh, none, |mesh| DelotetSteinerTermsView::new(&mesh.mesh.steiner_terms)) }
}

/// The flips that facet merging made, in order (see delotet_options_set_merge_facets). Borrowed from `mesh`. Empty for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_mesh_facet_flips(mesh: *const DelotetMesh) -> DelotetFacetFlipsView {
    let none = DelotetFacetFlipsView::new(&[]);
    // SAFETY: the caller passes NULL or a mesh that is alive.
    unsafe { read(mesh, none, |mesh| DelotetFacetFlipsView::new(&mesh.mesh.facet_flips)) }
}

/// Counts and costs of the run that made a mesh. Later versions append fields; `struct_size` tells both sides which ones exist.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetStats {
    /// The caller sets it to sizeof(DelotetStats); the library sets it to the number of bytes written.
    pub struct_size: usize,
    /// Steiner points on segments and facet edges, without those of refinement.
    pub steiner: u64,
    /// Steiner points on segments, facet edges and facets whose double coordinates are exact, with those of refinement.
    pub steiner_exact: u64,
    /// Steiner points moved to another position because the nearest doubles were not valid.
    pub steiner_moved: u64,
    /// Input points that equal an earlier one.
    pub duplicate_points: u64,
    /// Segments missing from the Delaunay tetrahedralization of the points.
    pub missing_segments: u64,
    /// Missing regions that facet recovery filled.
    pub missing_regions: u64,
    /// Peak size of the engine's arrays in bytes.
    pub peak_bytes: u64,
    /// Seconds per phase, indexed by DelotetPhase; unused entries are 0.
    pub seconds: [f64; 16],
    /// Edges of the surface missing from the Delaunay tetrahedralization of the points. Like all `preserve_` fields, 0 except in
    /// DELOTET_MODE_PRESERVE.
    pub preserve_missing_edges: u64,
    /// Triangles of the surface missing from that tetrahedralization.
    pub preserve_missing_faces: u64,
    /// Edges and faces recovered by reconnecting tetrahedra alone.
    pub preserve_by_reconnection: u64,
    /// Edges and faces recovered with the help of points inside.
    pub preserve_by_interior_points: u64,
    /// Edges and faces recovered by points on them that were removed again.
    pub preserve_by_splits: u64,
    /// Points on the surface removed without a replacement.
    pub preserve_deleted: u64,
    /// Points on the surface replaced by points inside.
    pub preserve_relocated: u64,
    /// Points added inside for the surface that remain in the mesh, without those of filling and optimisation.
    pub preserve_interior: u64,
    /// Points left on internal facets and segments (DELOTET_PRESERVE_OUTER).
    pub preserve_on_internal_facets: u64,
    /// Tetrahedra that replace ones for which no double coordinates gave a positive volume (delotet_mesh_replaced_tets()).
    pub replaced: u64,
    /// Peak resident memory of the process up to the end of the run in bytes, including the host program's; 0 if the system does not report
    /// it.
    pub peak_resident_bytes: u64,
    /// Points that filling and refinement put on segments and facet edges. Like all `refine_` fields, 0 if nothing was filled.
    pub refine_on_segments: u64,
    /// Points that they put on facets.
    pub refine_on_facets: u64,
    /// Points that they put inside.
    pub refine_inside: u64,
    /// Of these points, how many came for a length, an area or a volume.
    pub refine_for_sizes: u64,
    /// How many came for a radius-edge ratio.
    pub refine_for_shapes: u64,
    /// Places refused since a vertex was too near.
    pub refine_too_near: u64,
    /// Places refused since the tetrahedron between them and the surface would have been too flat.
    pub refine_too_flat: u64,
    /// Places put off since they were in the sphere of a piece of the surface, which came first.
    pub refine_encroaching: u64,
    /// Places refused since a piece of the surface was in the way.
    pub refine_blocked: u64,
    /// Places refused for other reasons.
    pub refine_elsewhere: u64,
    /// Tetrahedra and pieces of facets above the ratio that were left since no more points may come for shapes; 0 if these were enough.
    pub refine_over_budget: u64,
    /// Passes of the optimisation over the bad tetrahedra. Like all `optimize_` fields, 0 if there was none.
    pub optimize_passes: u64,
    /// Moves of points; one may move more than once.
    pub optimize_moves: u64,
    /// Edges removed.
    pub optimize_edges_removed: u64,
    /// Removals of faces, of one or more at a time.
    pub optimize_faces_removed: u64,
    /// Cavities filled anew.
    pub optimize_reconnected: u64,
    /// Points that came.
    pub optimize_points_added: u64,
    /// Points that went into a neighbour.
    pub optimize_points_removed: u64,
    /// The worst dihedral angle before, in degrees: the least of all angles, and of what is missing of them to 180 degrees.
    pub optimize_worst_before: f64,
    /// The same after it.
    pub optimize_worst_after: f64,
}
const _: () = assert!(Phase::COUNT <= 16);

impl DelotetStats {
    fn new(mesh: &DelotetMesh) -> DelotetStats {
        let statistics = &mesh.mesh.statistics;
        let mut seconds = [0.0; 16];
        seconds[..Phase::COUNT].copy_from_slice(&statistics.seconds);
        DelotetStats {
            struct_size: size_of::<DelotetStats>(),
            steiner: statistics.steiner,
            steiner_exact: statistics.steiner_exact,
            steiner_moved: statistics.steiner_moved,
            duplicate_points: statistics.duplicate_points,
            missing_segments: statistics.missing_segments,
            missing_regions: statistics.missing_regions,
            peak_bytes: statistics.peak_bytes,
            seconds,
            preserve_missing_edges: statistics.preserve.missing_edges,
            preserve_missing_faces: statistics.preserve.missing_faces,
            preserve_by_reconnection: statistics.preserve.by_reconnection,
            preserve_by_interior_points: statistics.preserve.by_interior_points,
            preserve_by_splits: statistics.preserve.by_splits,
            preserve_deleted: statistics.preserve.deleted,
            preserve_relocated: statistics.preserve.relocated,
            preserve_interior: statistics.preserve.interior,
            preserve_on_internal_facets: statistics.preserve.on_internal_facets,
            replaced: statistics.replaced,
            peak_resident_bytes: mesh.peak_resident,
            refine_on_segments: statistics.refine.on_segments,
            refine_on_facets: statistics.refine.on_facets,
            refine_inside: statistics.refine.inside,
            refine_for_sizes: statistics.refine.for_sizes,
            refine_for_shapes: statistics.refine.for_shapes,
            refine_too_near: statistics.refine.too_near,
            refine_too_flat: statistics.refine.too_flat,
            refine_encroaching: statistics.refine.encroaching,
            refine_blocked: statistics.refine.blocked,
            refine_elsewhere: statistics.refine.elsewhere,
            refine_over_budget: statistics.refine.over_budget,
            optimize_passes: statistics.optimize.passes,
            optimize_moves: statistics.optimize.moves,
            optimize_edges_removed: statistics.optimize.edges_removed,
            optimize_faces_removed: statistics.optimize.faces_removed,
            optimize_reconnected: statistics.optimize.reconnected,
            optimize_points_added: statistics.optimize.points_added,
            optimize_points_removed: statistics.optimize.points_removed,
            optimize_worst_before: statistics.optimize.worst_before,
            optimize_worst_after: statistics.optimize.worst_after,
        }
    }

    /// Writes as many bytes as the caller's struct holds.
    ///
    /// # Safety
    /// `stats` is null or has a readable `struct_size` and as many writable bytes as that says.
    unsafe fn write(mut self, stats: *mut DelotetStats) -> Result<(), Error> {
        if stats.is_null() {
            return Err(null("stats"));
        }
        // SAFETY: not null, and the caller promises the rest.
        let size = unsafe { (&raw const (*stats).struct_size).read() }.min(self.struct_size);
        if size < size_of::<usize>() {
            return Err(invalid("stats->struct_size is not set"));
        }
        self.struct_size = size;
        // SAFETY: `size` bytes of both structs are valid, and they do not overlap.
        unsafe { std::ptr::copy_nonoverlapping((&raw const self).cast::<u8>(), stats.cast::<u8>(), size) };
        Ok(())
    }
}

/// Counts and costs of the run. Set `stats->struct_size = sizeof *stats` before the call.
/// Errors: INVALID_ARGUMENT (NULL, or a `struct_size` smaller than that field itself).
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_mesh_stats(
    mesh: *const DelotetMesh,
    stats: *mut DelotetStats,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a mesh that is alive, a struct of which `struct_size` bytes may be written, and NULL or a valid
    // out-parameter.
    unsafe { guard(out_error, || DelotetStats::new(get(mesh, "mesh")?).write(stats)) }
}

/// The PLC and the mesh that the checks compare.
///
/// # Safety
/// The handles are NULL or alive, and nothing changes them during `'a`.
unsafe fn compared<'a>(
    plc: *const DelotetPlc,
    mesh: *const DelotetMesh,
) -> Result<(&'a Plc, &'a TetMesh), Error> {
    // SAFETY: as the caller's.
    unsafe { Ok((&get(plc, "plc")?.plc, &get(mesh, "mesh")?.mesh)) }
}

/// Checks a mesh against its PLC exactly: all tetrahedra are positive and conforming, points are unmoved, segments and facets are covered;
/// with `constrained_delaunay` also that every unconstrained face is locally Delaunay. A facet without any subfaces in the mesh is a
/// defect, unless the mesh was made in mode DELOTET_MODE_DELAUNAY: then facets and segments are not checked. The error lists at most
/// `max_defects`.
/// Errors: INVALID_ARGUMENT, CHECK_FAILED, OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_mesh_check(
    mesh: *const DelotetMesh,
    plc: *const DelotetPlc,
    constrained_delaunay: bool,
    max_defects: usize,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes handles that nothing changes meanwhile.
    unsafe {
        guard(out_error, || {
            compared(plc, mesh).and_then(|(plc, mesh)| {
                crate::check::check_mesh(plc, mesh, constrained_delaunay, max_defects)
            })
        })
    }
}

/// Checks a mesh like delotet_mesh_check() without the Delaunay property, and also that it keeps the surface as DELOTET_MODE_PRESERVE
/// promises: every input triangle is a face (or, if input points lie on it, a union of faces with these as corners), every polygon is a
/// union of faces and every segment one of edges between input points, and no added point lies on a facet or segment. This is checked
/// whatever the mode of the mesh. The error lists at most `max_defects`. Errors: INVALID_ARGUMENT, CHECK_FAILED, OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_mesh_check_preserved(
    mesh: *const DelotetMesh,
    plc: *const DelotetPlc,
    max_defects: usize,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes handles that nothing changes meanwhile.
    unsafe {
        guard(out_error, || {
            compared(plc, mesh).and_then(|(plc, mesh)| crate::check::check_preserved(plc, mesh, max_defects))
        })
    }
}

/// Checks a mesh like delotet_mesh_check_preserved(), but only its outer boundary, as DELOTET_PRESERVE_OUTER promises: other facets and
/// segments must be covered and may carry added points. The error lists at most `max_defects`.
/// Errors: INVALID_ARGUMENT, CHECK_FAILED, OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_mesh_check_preserved_outer(
    mesh: *const DelotetMesh,
    plc: *const DelotetPlc,
    max_defects: usize,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes handles that nothing changes meanwhile.
    unsafe {
        guard(out_error, || {
            compared(plc, mesh)
                .and_then(|(plc, mesh)| crate::check::check_preserved_outer(plc, mesh, max_defects))
        })
    }
}

/// Frees a mesh and everything borrowed from it. NULL is ignored.
#[no_mangle]
pub unsafe extern "C" fn delotet_mesh_free(mesh: *mut DelotetMesh) {
    // SAFETY: the caller passes NULL or a mesh that it owns.
    unsafe { free(mesh) }
}
