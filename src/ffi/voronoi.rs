//! Voronoi and power diagrams.
use crate::ffi::error::DelotetError;
use crate::ffi::guard::{free, get, guard, read, Out};
use crate::ffi::mesh::DelotetMesh;
use crate::ffi::options::{with_settings, DelotetOptions};
use crate::ffi::status::DelotetStatus;
use crate::ffi::view::{records, same_layout, DelotetIndicesView, DelotetPointsView};
use crate::query::{Voronoi, VoronoiCell, VoronoiEdge, VoronoiFacet};
use std::mem::offset_of;

/// The Voronoi diagram of the points of a mesh, or their power diagram: immutable, so any number of threads may read it.
pub struct DelotetVoronoi {
    voronoi: Voronoi,
}

/// An edge of a Voronoi diagram, dual to a face of the mesh.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetVoronoiEdge {
    /// Its ends; the second is DELOTET_INVALID_INDEX for a ray.
    pub vertices: [u32; 2],
    /// The direction of a ray, of length 1: the outward normal of the face of the convex hull. Zero for an edge with two ends.
    pub direction: [f64; 3],
}

/// Borrowed edges of a Voronoi diagram; NULL and 0 if there are none.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetVoronoiEdgesView {
    /// The first of `count` edges; DELOTET_AT(DelotetVoronoiEdge, view, i) is the i-th.
    pub first: *const DelotetVoronoiEdge,
    /// Number of elements.
    pub count: usize,
    /// Bytes from one element to the next.
    pub stride: usize,
}
records!(DelotetVoronoiEdgesView, DelotetVoronoiEdge, VoronoiEdge);
same_layout!(DelotetVoronoiEdge, VoronoiEdge, vertices = vertices, direction = direction);

/// A facet of a Voronoi diagram, dual to an edge of the mesh: a convex polygon between two cells, in the plane of points that have equal
/// (power) distances from both.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetVoronoiFacet {
    /// Its cells: the points whose edge it is dual to, the smaller first.
    pub cells: [u32; 2],
    /// Where its edges begin in delotet_voronoi_facet_edges(). They follow each other counterclockwise, seen from the second point; if it
    /// is unbounded, from one ray to the other.
    pub first: usize,
    /// The number of its edges.
    pub count: u32,
    /// Whether it is bounded.
    pub bounded: bool,
}

/// Borrowed facets of a Voronoi diagram; NULL and 0 if there are none.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetVoronoiFacetsView {
    /// The first of `count` facets; DELOTET_AT(DelotetVoronoiFacet, view, i) is the i-th.
    pub first: *const DelotetVoronoiFacet,
    /// Number of elements.
    pub count: usize,
    /// Bytes from one element to the next.
    pub stride: usize,
}
records!(DelotetVoronoiFacetsView, DelotetVoronoiFacet, VoronoiFacet);
same_layout!(
    DelotetVoronoiFacet,
    VoronoiFacet,
    cells = cells,
    first = first,
    count = count,
    bounded = bounded
);

/// The cell of a point.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetVoronoiCell {
    /// Where its facets begin in delotet_voronoi_cell_facets(), ascending.
    pub first: usize,
    /// The number of its facets; 0 if there is no cell: the point is hidden by others, or equal to an earlier one.
    pub count: u32,
    /// Whether there is a cell, and it is bounded.
    pub bounded: bool,
}

/// Borrowed cells of a Voronoi diagram; NULL and 0 if there are none.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetVoronoiCellsView {
    /// The first of `count` cells; DELOTET_AT(DelotetVoronoiCell, view, i) is the i-th.
    pub first: *const DelotetVoronoiCell,
    /// Number of elements.
    pub count: usize,
    /// Bytes from one element to the next.
    pub stride: usize,
}
records!(DelotetVoronoiCellsView, DelotetVoronoiCell, VoronoiCell);
same_layout!(DelotetVoronoiCell, VoronoiCell, first = first, count = count, bounded = bounded);

/// Makes the Voronoi diagram of a mesh made in DELOTET_MODE_DELAUNAY; with weights of points (delotet_plc_set_point_weights()) the power
/// diagram. It is the dual of the mesh as it is: a vertex per tetrahedron, an edge per face (delotet_mesh_faces()), a facet per edge
/// (delotet_mesh_edges()), a cell per point, in the same order. Five and more cospherical points have several vertices at the same place,
/// and edges and facets of no extent between them.
/// `options`: NULL, or options whose limits and token end it; nothing else of them counts. `out_voronoi`: the diagram, owned by the caller,
/// which needs the mesh no longer; free it with delotet_voronoi_free(). NULL on failure.
/// Errors: INVALID_ARGUMENT, UNSUPPORTED (another mesh; a weighted one whose weights are not known, as read from files), COORDINATE_RANGE,
/// CANCELLED, TIME_LIMIT, MEMORY_LIMIT, TOO_LARGE, OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_voronoi_new(
    mesh: *const DelotetMesh,
    options: *const DelotetOptions,
    out_voronoi: *mut *mut DelotetVoronoi,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes handles that nothing changes meanwhile, and NULL or valid out-parameters.
    unsafe {
        guard(out_error, || {
            let out = Out::new(out_voronoi, "out_voronoi")?;
            let mesh = &get(mesh, "mesh")?.mesh;
            let voronoi = with_settings(options, |_, control| Voronoi::new_with(mesh, control))?;
            out.put(DelotetVoronoi { voronoi })
        })
    }
}

/// The vertices: for each tetrahedron the centre of the sphere through its corners (with weights: the point of equal power distances), each
/// coordinate the double nearest to the exact one; infinite where the centre of a nearly flat tetrahedron is beyond the range of doubles.
/// Borrowed from `voronoi`. Empty for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_voronoi_vertices(voronoi: *const DelotetVoronoi) -> DelotetPointsView {
    let none = DelotetPointsView::new(&[]);
    // SAFETY: the caller passes NULL or a diagram that is alive.
    unsafe { read(voronoi, none, |v| DelotetPointsView::new(&v.voronoi.vertices)) }
}

/// The edges, one per face of the mesh. Borrowed from `voronoi`. Empty for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_voronoi_edges(voronoi: *const DelotetVoronoi) -> DelotetVoronoiEdgesView {
    let none = DelotetVoronoiEdgesView::new(&[]);
    // SAFETY: the caller passes NULL or a diagram that is alive.
    unsafe { read(voronoi, none, |v| DelotetVoronoiEdgesView::new(&v.voronoi.edges)) }
}

/// The facets, one per edge of the mesh. Borrowed from `voronoi`. Empty for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_voronoi_facets(voronoi: *const DelotetVoronoi) -> DelotetVoronoiFacetsView {
    let none = DelotetVoronoiFacetsView::new(&[]);
    // SAFETY: the caller passes NULL or a diagram that is alive.
    unsafe { read(voronoi, none, |v| DelotetVoronoiFacetsView::new(&v.voronoi.facets)) }
}

/// The edges of all facets, one facet after the other. Borrowed from `voronoi`. Empty for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_voronoi_facet_edges(voronoi: *const DelotetVoronoi) -> DelotetIndicesView {
    let none = DelotetIndicesView::new(&[]);
    // SAFETY: the caller passes NULL or a diagram that is alive.
    unsafe { read(voronoi, none, |v| DelotetIndicesView::new(&v.voronoi.facet_edges)) }
}

/// The cells, one per point of the mesh. Borrowed from `voronoi`. Empty for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_voronoi_cells(voronoi: *const DelotetVoronoi) -> DelotetVoronoiCellsView {
    let none = DelotetVoronoiCellsView::new(&[]);
    // SAFETY: the caller passes NULL or a diagram that is alive.
    unsafe { read(voronoi, none, |v| DelotetVoronoiCellsView::new(&v.voronoi.cells)) }
}

/// The facets of all cells, one cell after the other. Borrowed from `voronoi`. Empty for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_voronoi_cell_facets(voronoi: *const DelotetVoronoi) -> DelotetIndicesView {
    let none = DelotetIndicesView::new(&[]);
    // SAFETY: the caller passes NULL or a diagram that is alive.
    unsafe { read(voronoi, none, |v| DelotetIndicesView::new(&v.voronoi.cell_facets)) }
}

/// Frees a diagram and everything borrowed from it. NULL is ignored.
#[no_mangle]
pub unsafe extern "C" fn delotet_voronoi_free(voronoi: *mut DelotetVoronoi) {
    // SAFETY: the caller passes NULL or a diagram that nothing uses any more.
    unsafe { free(voronoi) }
}

/// Handles may be passed between threads, and const ones shared.
const _: () = {
    const fn shareable<T: Send + Sync>() {}
    shareable::<DelotetVoronoi>();
};
