//! Weights of points, and the points that they hide.
use crate::error::Error;
use crate::fallible;
use crate::ffi::error::DelotetError;
use crate::ffi::guard::{get_mut, guard, invalid, read};
use crate::ffi::mesh::DelotetMesh;
use crate::ffi::plc::DelotetPlc;
use crate::ffi::slice::array;
use crate::ffi::status::DelotetStatus;
use crate::ffi::view::{DelotetDoublesView, DelotetIndicesView};
use crate::output::Lift;

impl DelotetPlc {
    /// One weight or height per point; none takes them all back.
    fn set_lift(&mut self, values: &[f64], lift: fn(Vec<f64>) -> Lift) -> Result<(), Error> {
        let points = self.plc.points.len();
        if !values.is_empty() && values.len() != points {
            return Err(invalid(format_args!("count is {}: the PLC has {points} points", values.len())));
        }
        if let Some(i) = values.iter().position(|x| !x.is_finite()) {
            return Err(invalid(format_args!("element {i} is {}, which is not finite", values[i])));
        }
        self.plc.lift = if values.is_empty() { Lift::Plain } else { lift(fallible::copied(values)?) };
        Ok(())
    }
}

/// Sets the weights of all points, replacing earlier weights or heights: DELOTET_MODE_DELAUNAY then makes the weighted Delaunay (regular)
/// tetrahedralization, in which of two points the one with the smaller power distance, squared distance minus weight, is the nearer one. A
/// point may be hidden by others: it belongs to no tetrahedron (delotet_mesh_hidden_points()). Equal points count as one with the largest of
/// their weights; equal weights change nothing. Signs are exact for the weights as they are given. One thread inserts weighted points.
/// `weights`: `count` finite doubles of any sign, in the square of the unit of coordinates; copied. `count`: the number of points, or 0,
/// which removes weights and heights. Points added later have the weight 0.
/// delotet_tetrahedralize() fails with INVALID_ARGUMENT if the PLC has facets or segments as well, or in another mode, and with
/// COORDINATE_RANGE if a weight is too far from the squares of the coordinates. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_plc_set_point_weights(
    plc: *mut DelotetPlc,
    weights: *const f64,
    count: usize,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a PLC that nothing else uses and an array of that size.
    unsafe {
        guard(out_error, || get_mut(plc, "plc")?.set_lift(array(weights, count, "weights")?, Lift::Weights))
    }
}

/// Sets the heights to which all points are lifted in the fourth dimension, instead of weights (delotet_plc_set_point_weights()) and with
/// the same effect: the height h stands for the weight x² + y² + z² - h, exactly. Of equal points the smallest height counts.
/// `heights`: `count` finite doubles; copied. `count`: the number of points, or 0, which removes weights and heights. Points added later
/// have the height 0. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_plc_set_point_heights(
    plc: *mut DelotetPlc,
    heights: *const f64,
    count: usize,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a PLC that nothing else uses and an array of that size.
    unsafe {
        guard(out_error, || get_mut(plc, "plc")?.set_lift(array(heights, count, "heights")?, Lift::Heights))
    }
}

/// The weights or heights of the points: one per point, or none at all. Borrowed from `plc`: valid until it is changed or freed. Empty for
/// NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_plc_point_weights(plc: *const DelotetPlc) -> DelotetDoublesView {
    let none = DelotetDoublesView::new(&[], 1);
    // SAFETY: the caller passes NULL or a PLC that nothing changes meanwhile.
    unsafe { read(plc, none, |plc| DelotetDoublesView::new(plc.plc.lift.values(), 1)) }
}

/// Points that others hide by their weights, in ascending order: they belong to no tetrahedron, and are among
/// delotet_mesh_unmeshed_points(). Borrowed from `mesh`. Empty for NULL, without weights, and with
/// delotet_options_set_drop_unmeshed_points(): delotet_mesh_point_map() then tells which are left out.
#[no_mangle]
pub unsafe extern "C" fn delotet_mesh_hidden_points(mesh: *const DelotetMesh) -> DelotetIndicesView {
    let none = DelotetIndicesView::new(&[]);
    // SAFETY: the caller passes NULL or a mesh that is alive.
    unsafe { read(mesh, none, |mesh| DelotetIndicesView::new(&mesh.mesh.hidden_points)) }
}

/// The weights or heights of the points that counted, in the order of delotet_mesh_points(): one per point. Of equal points the first has the
/// value that counts for all. Borrowed from `mesh`. Empty for NULL and without weights.
#[no_mangle]
pub unsafe extern "C" fn delotet_mesh_point_weights(mesh: *const DelotetMesh) -> DelotetDoublesView {
    let none = DelotetDoublesView::new(&[], 1);
    // SAFETY: the caller passes NULL or a mesh that is alive.
    unsafe { read(mesh, none, |mesh| DelotetDoublesView::new(mesh.mesh.lift.values(), 1)) }
}
