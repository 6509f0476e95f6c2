//! The function that makes a mesh.
use crate::ffi::error::DelotetError;
use crate::ffi::guard::{get, guard, Out};
use crate::ffi::mesh::DelotetMesh;
use crate::ffi::options::{with_settings, DelotetOptions};
use crate::ffi::plc::DelotetPlc;
use crate::ffi::status::DelotetStatus;
use crate::plan::tetrahedralize_with;
use crate::query::PointData;

/// Makes the mesh of a PLC.
/// `options`: NULL for the defaults. `out_mesh`: the mesh, owned by the caller; free it with delotet_mesh_free(). NULL on failure. It does
/// not refer to `plc` or `options`. `out_error`: may be NULL; receives NULL on success, otherwise an error that lists the elements at
/// fault, to be freed with delotet_error_free().
/// The same input and options give the same mesh, bit for bit. The calling thread needs little stack: 256 KiB suffice.
/// Errors: INVALID_ARGUMENT, the statuses from 10 to 41, INTERNAL.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_tetrahedralize(
    plc: *const DelotetPlc,
    options: *const DelotetOptions,
    out_mesh: *mut *mut DelotetMesh,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes handles that nothing changes meanwhile, and NULL or valid out-parameters.
    unsafe {
        guard(out_error, || {
            let out = Out::new(out_mesh, "out_mesh")?;
            let plc = &get(plc, "plc")?.plc;
            let mesh = with_settings(options, |options, control| tetrahedralize_with(plc, options, control))?;
            let data = PointData::new(plc, &mesh)?;
            out.put(DelotetMesh::new(mesh, data)?)
        })
    }
}
