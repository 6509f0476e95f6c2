//! Data derived from a mesh: faces, edges, second-order nodes, point location. Computed on first use and kept with the mesh; two threads
//! that ask at the same time may both compute it, and one result is kept.
use crate::error::Error;
use crate::ffi::error::DelotetError;
use crate::ffi::guard::{get, guard, invalid, set};
use crate::ffi::mesh::DelotetMesh;
use crate::ffi::slice::{array, array_mut};
use crate::ffi::status::DelotetStatus;
use crate::ffi::view::*;
use crate::query::{second_order, Edges, Faces, Locator, NodeOrder};
use std::sync::OnceLock;

/// In which order the six mid-edge nodes follow the four corners of a tetrahedron: one of the DELOTET_NODE_ORDER_ constants.
pub type DelotetNodeOrder = u32;
/// VTK, Abaqus and CalculiX (C3D10), Nastran: nodes on the edges 01 12 02 03 13 23.
pub const DELOTET_NODE_ORDER_VTK: DelotetNodeOrder = 0;
/// Gmsh: nodes on the edges 01 12 02 03 23 13.
pub const DELOTET_NODE_ORDER_GMSH: DelotetNodeOrder = 1;
/// TetGen (-o2): nodes on the edges 23 03 01 12 13 02.
pub const DELOTET_NODE_ORDER_TETGEN: DelotetNodeOrder = 2;

/// The value of a slot, computed by `make` if it is still empty. Fails if `make` does.
pub(super) fn kept<T>(slot: &OnceLock<T>, make: impl FnOnce() -> Result<T, Error>) -> Result<&T, Error> {
    if let Some(value) = slot.get() {
        return Ok(value);
    }
    let value = make()?;
    Ok(slot.get_or_init(|| value))
}

impl DelotetMesh {
    fn faces(&self) -> Result<&Faces, Error> {
        kept(&self.derived.faces, || Faces::new(&self.mesh))
    }

    fn edges(&self) -> Result<&Edges, Error> {
        kept(&self.derived.edges, || Edges::new(&self.mesh))
    }

    fn second_order(&self, node_order: DelotetNodeOrder) -> Result<DelotetSecondOrderView, Error> {
        let order = match node_order {
            DELOTET_NODE_ORDER_VTK => NodeOrder::Vtk,
            DELOTET_NODE_ORDER_GMSH => NodeOrder::Gmsh,
            DELOTET_NODE_ORDER_TETGEN => NodeOrder::Tetgen,
            _ => {
                return Err(invalid(format_args!(
                    "node_order {node_order} is not a DELOTET_NODE_ORDER_ constant"
                )))
            }
        };
        let edges = self.edges()?;
        let nodes = kept(&self.derived.nodes, || second_order::nodes(&self.mesh, edges))?;
        let slot = &self.derived.tets10[node_order as usize];
        let tets = kept(slot, || second_order::tets(&self.mesh, edges, order))?;
        Ok(DelotetSecondOrderView::new(nodes, tets))
    }
}

/// The region attribute of each tetrahedron: #tetrahedra by 1. Computed on first use; borrowed from `mesh`, valid until it is freed.
/// Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_mesh_tet_attributes(
    mesh: *const DelotetMesh,
    out_view: *mut DelotetDoublesView,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a mesh that is alive, and NULL or valid out-parameters.
    unsafe {
        guard(out_error, || {
            let mesh = get(mesh, "mesh")?;
            let list = kept(&mesh.derived.tet_attributes, || crate::query::tet_attributes(&mesh.mesh))?;
            set(out_view, DelotetDoublesView::new(list, 1), "out_view")
        })
    }
}

/// For each point the first tetrahedron that has it as a corner, or DELOTET_INVALID_INDEX if there is none. Computed on first use; borrowed
/// from `mesh`. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_mesh_point_tets(
    mesh: *const DelotetMesh,
    out_view: *mut DelotetIndicesView,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a mesh that is alive, and NULL or valid out-parameters.
    unsafe {
        guard(out_error, || {
            let mesh = get(mesh, "mesh")?;
            let list = kept(&mesh.derived.point_tets, || crate::query::point_tets(&mesh.mesh))?;
            set(out_view, DelotetIndicesView::new(list), "out_view")
        })
    }
}

/// All faces, each once; delotet_mesh_subfaces() has only the constrained ones. Computed on first use; borrowed from `mesh`.
/// Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_mesh_faces(
    mesh: *const DelotetMesh,
    out_view: *mut DelotetFacesView,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a mesh that is alive, and NULL or valid out-parameters.
    unsafe {
        guard(out_error, || {
            let mesh = get(mesh, "mesh")?;
            set(out_view, DelotetFacesView::new(&mesh.faces()?.faces), "out_view")
        })
    }
}

/// For each tetrahedron its four faces (indices into delotet_mesh_faces()), face i opposite corner i. Computed on first use; borrowed from
/// `mesh`. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_mesh_tet_faces(
    mesh: *const DelotetMesh,
    out_view: *mut DelotetTetsView,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a mesh that is alive, and NULL or valid out-parameters.
    unsafe {
        guard(out_error, || {
            let mesh = get(mesh, "mesh")?;
            set(out_view, DelotetTetsView::new(&mesh.faces()?.tet_faces), "out_view")
        })
    }
}

/// All edges, each once, sorted by their ends; delotet_mesh_subsegments() has only the constrained ones. Computed on first use; borrowed
/// from `mesh`. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY, TOO_LARGE.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_mesh_edges(
    mesh: *const DelotetMesh,
    out_view: *mut DelotetEdgesView,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a mesh that is alive, and NULL or valid out-parameters.
    unsafe {
        guard(out_error, || {
            let mesh = get(mesh, "mesh")?;
            set(out_view, DelotetEdgesView::new(&mesh.edges()?.edges), "out_view")
        })
    }
}

/// For each tetrahedron its edges 01 02 03 12 13 23 (indices into delotet_mesh_edges()): #tetrahedra by 6. Computed on first use; borrowed
/// from `mesh`. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY, TOO_LARGE.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_mesh_tet_edges(
    mesh: *const DelotetMesh,
    out_view: *mut DelotetIndexRowsView,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a mesh that is alive, and NULL or valid out-parameters.
    unsafe {
        guard(out_error, || {
            let mesh = get(mesh, "mesh")?;
            set(out_view, DelotetIndexRowsView::new(&mesh.edges()?.tet_edges), "out_view")
        })
    }
}

/// For each subface (a, b, c) its edges ab bc ca (indices into delotet_mesh_edges()): #subfaces by 3. In a second-order mesh the node on
/// edge i has the index #points + i. Computed on first use; borrowed from `mesh`. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY, TOO_LARGE.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_mesh_subface_edges(
    mesh: *const DelotetMesh,
    out_view: *mut DelotetIndexRowsView,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a mesh that is alive, and NULL or valid out-parameters.
    unsafe {
        guard(out_error, || {
            let mesh = get(mesh, "mesh")?;
            set(out_view, DelotetIndexRowsView::new(&mesh.edges()?.subface_edges), "out_view")
        })
    }
}

/// Second-order tetrahedra: a node at the midpoint of every edge (rounded to doubles), shared by all tetrahedra around it. `node_order`: a
/// DELOTET_NODE_ORDER_ constant. Computed on first use; borrowed from `mesh`.
/// Errors: INVALID_ARGUMENT, OUT_OF_MEMORY, TOO_LARGE.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_mesh_second_order(
    mesh: *const DelotetMesh,
    node_order: DelotetNodeOrder,
    out_view: *mut DelotetSecondOrderView,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a mesh that is alive, and NULL or valid out-parameters.
    unsafe {
        guard(out_error, || {
            let mesh = get(mesh, "mesh")?;
            set(out_view, mesh.second_order(node_order)?, "out_view")
        })
    }
}

/// Finds the tetrahedra that contain points, exactly. A point on a shared face, edge or corner belongs to the tetrahedron with the smallest
/// index.
/// `xyz`: #points by 3 doubles. `out_tets`: room for #points indices; receives DELOTET_INVALID_INDEX for points outside the mesh and points
/// that are not finite. `out_barycentric`: NULL, or room for #points by 4 doubles; receives the barycentric coordinates in that
/// tetrahedron, none negative, with sum 1 up to rounding; NaN outside. A linear field at the point is the sum of each coordinate times the
/// value at its corner. The search tree is built on first use and kept: about 40 bytes per tetrahedron.
/// Errors: INVALID_ARGUMENT, OUT_OF_MEMORY; then nothing was written.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_mesh_locate(
    mesh: *const DelotetMesh,
    xyz: *const f64,
    point_count: usize,
    out_tets: *mut u32,
    out_barycentric: *mut f64,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a mesh that is alive and arrays of these sizes that do not overlap.
    unsafe {
        guard(out_error, || {
            let mesh = get(mesh, "mesh")?;
            let points = array(xyz.cast::<[f64; 3]>(), point_count, "xyz")?;
            let tets = array_mut(out_tets, point_count, "out_tets")?;
            let count = if out_barycentric.is_null() { 0 } else { point_count };
            let weights = array_mut(out_barycentric.cast::<[f64; 4]>(), count, "out_barycentric")?;
            let locator = kept(&mesh.derived.locator, || Locator::new(&mesh.mesh))?;
            locator.locate(&mesh.mesh, points, tets, Some(weights));
            Ok(())
        })
    }
}
