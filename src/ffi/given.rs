//! Meshes that are given: from arrays and files, refined and improved, with sizes of their own.
use crate::error::{Error, Status};
use crate::fallible;
use crate::ffi::error::DelotetError;
use crate::ffi::file::{path_of, read_mesh};
use crate::ffi::guard::{free, get, get_mut, guard, make, Out};
use crate::ffi::mesh::DelotetMesh;
use crate::ffi::options::{with_settings, DelotetOptions};
use crate::ffi::slice::{array, optional};
use crate::ffi::status::DelotetStatus;
use crate::output::MeshArrays;
use crate::plan::given::{improve_with, mesh_from_arrays_with, refine_with, MeshSizes};
use crate::query::PointData;
use libc::c_char;

/// Edge lengths wanted in a mesh that is to be refined: at its points, in its tetrahedra, and by markers and attributes.
pub struct DelotetMeshSizes {
    sizes: MeshSizes,
}

/// A copy of an array.
///
/// # Safety
/// `pointer` is valid for reads of `count` elements, unless `count` is 0.
unsafe fn copied<T: Copy>(pointer: *const T, count: usize, name: &str) -> Result<Vec<T>, Error> {
    // SAFETY: the caller promises the same.
    Ok(fallible::copied(unsafe { array(pointer, count, name) }?)?)
}

/// What elements and the numbers on them are called in messages.
const FACES: [&str; 2] = ["faces", "face_markers"];
const EDGES: [&str; 2] = ["edges", "edge_markers"];

/// Copies of elements by their corners, and of the numbers on them if these are not NULL.
///
/// # Safety
/// `corners` is valid for reads of `count` rows, unless `count` is 0; `numbers` is NULL or valid for reads of `count` elements.
unsafe fn rows<const N: usize, T: Copy>(
    corners: *const u32,
    count: usize,
    numbers: *const T,
    names: [&str; 2],
) -> Result<(Vec<[u32; N]>, Vec<T>), Error> {
    // SAFETY: the caller promises the same.
    let (corners, numbers) = unsafe {
        (copied(corners.cast::<[u32; N]>(), count, names[0])?, optional(numbers, count, names[1])?)
    };
    Ok((corners, fallible::copied(numbers.unwrap_or_default())?))
}

/// Makes a mesh of arrays: one made elsewhere, or in an earlier run. All arrays are copied.
/// `xyz`: #points by 3 doubles. `input_point_count`: how many of them are input points, at most `point_count`: these keep their place in
/// every later mesh. The others may be moved and taken out later, but only those behind the last point that is on a kept face or edge: up
/// to that one all count as input points.
/// `tets`: #tetrahedra by 4 corners, in either orientation. `attributes`: NULL, or one double per tetrahedron; equal ones are one material.
/// `faces`: #faces by 3 corners, faces of the mesh that are to be kept; may be NULL if `face_count` is 0. Those on the boundary and between
/// different attributes are kept in any case, with marker 0. `face_markers`: NULL, or one per face.
/// `edges`: #edges by 2 ends, edges of the mesh that are to be kept; may be NULL if `edge_count` is 0. `edge_markers`: NULL, or one per edge.
/// `options`: NULL, or options whose limits count, and how many defects an error lists.
/// `out_mesh`: the mesh, owned by the caller; free it with delotet_mesh_free(). NULL on failure. The facet of a subface is the index of the
/// given face (others are numbered after them), the segment of a subsegment that of the given edge. Of equal points tetrahedra use the first.
/// Errors: INVALID_ARGUMENT (also without tetrahedra, and for attributes that are not finite), NON_FINITE_POINT, COORDINATE_RANGE,
/// INDEX_OUT_OF_RANGE; CHECK_FAILED: a tetrahedron is flat, a face belongs to more than two tetrahedra or to two on one side, tetrahedra with
/// a common edge overlap, a given face or edge is none of the mesh; CANCELLED, TIME_LIMIT, MEMORY_LIMIT, TOO_LARGE, OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_mesh_from_arrays(
    xyz: *const f64,
    point_count: usize,
    input_point_count: usize,
    tets: *const u32,
    tet_count: usize,
    attributes: *const f64,
    faces: *const u32,
    face_count: usize,
    face_markers: *const i32,
    edges: *const u32,
    edge_count: usize,
    edge_markers: *const i32,
    options: *const DelotetOptions,
    out_mesh: *mut *mut DelotetMesh,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes arrays of these sizes, NULL or options that nothing changes meanwhile, and NULL or valid out-parameters.
    unsafe {
        guard(out_error, || {
            let out = Out::new(out_mesh, "out_mesh")?;
            let points = copied(xyz.cast::<[f64; 3]>(), point_count, "xyz")?;
            let mut arrays = MeshArrays { points, ..MeshArrays::default() };
            arrays.input_point_count = Some(at_most(input_point_count, point_count)?);
            (arrays.tets, arrays.attributes) = rows(tets, tet_count, attributes, ["tets", "attributes"])?;
            (arrays.faces, arrays.face_markers) = rows(faces, face_count, face_markers, FACES)?;
            (arrays.edges, arrays.edge_markers) = rows(edges, edge_count, edge_markers, EDGES)?;
            out.put(given(arrays, options)?)
        })
    }
}

/// The number of input points.
fn at_most(inputs: usize, points: usize) -> Result<u32, Error> {
    match u32::try_from(inputs) {
        Ok(count) if inputs <= points => Ok(count),
        _ => Err(Error::new(
            Status::InvalidArgument,
            format_args!("input_point_count is {inputs}, but there are {points} points"),
        )),
    }
}

/// A mesh of arrays.
///
/// # Safety
/// `options` is NULL or valid.
unsafe fn given(arrays: MeshArrays, options: *const DelotetOptions) -> Result<DelotetMesh, Error> {
    // SAFETY: the caller promises that a handle that is not NULL is valid.
    let mesh = unsafe {
        with_settings(options, |options, control| mesh_from_arrays_with(arrays, options.max_defects, control))
    }?;
    DelotetMesh::new(mesh, PointData::default())
}

/// Reads a mesh from a file; the extension determines the format: .ele (with .node, and .face and .edge if they are there), .vtu (with
/// STEM_subfaces.vtu if it is there), .msh, .mesh (src/doc/formats.md says what is read). It becomes a mesh as in
/// delotet_mesh_from_arrays(); all its points are input points. Attributes and markers of points are read where the format has them.
/// `path`: zero-terminated; any bytes on Unix, UTF-8 elsewhere. `options`: NULL, or options whose limits count. `out_mesh`: the mesh, owned
/// by the caller; free it with delotet_mesh_free(). NULL on failure.
/// Errors: as delotet_mesh_from_arrays(); UNSUPPORTED (unknown format, or the library was built without file formats), FILE, FORMAT.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_mesh_read(
    path: *const c_char,
    options: *const DelotetOptions,
    out_mesh: *mut *mut DelotetMesh,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a zero-terminated path, NULL or options that nothing changes meanwhile, and NULL or valid out-parameters.
    unsafe {
        guard(out_error, || {
            let out = Out::new(out_mesh, "out_mesh")?;
            let path = path_of(path)?;
            let (mesh, data) = with_settings(options, |options, control| {
                let (arrays, data) = read_mesh(path, control)?;
                Ok::<_, Error>((mesh_from_arrays_with(arrays, options.max_defects, control)?, data))
            })?;
            out.put(DelotetMesh::new(mesh, data)?)
        })
    }
}

/// Refines a mesh, one of delotet_tetrahedralize() or any other: adds points inside until sizes, volumes and shapes are as wanted, then
/// optimises if the options say so. Kept are subfaces and subsegments with facets, segments and markers, the regions, the input points, and
/// points of earlier runs on edges and facets, all in their order. Points inside of earlier runs come behind them, with the new ones; they may
/// have moved or gone. Surfaces are not refined: near a coarse one sizes are bounded by it. Of a mesh made with
/// delotet_options_set_drop_unmeshed_points() the remaining points count as the input.
/// `sizes`: NULL, or lengths wanted in this mesh. `options`: NULL for the defaults; those about filling (delotet_options_set_size() and what
/// follows it, in any mode), optimisation, limits and callbacks count. `out_mesh`: another mesh, owned by the caller; free it with
/// delotet_mesh_free(). NULL on failure. It does not refer to the other handles. Attributes of points are interpolated at new ones.
/// The same mesh, sizes and options give the same result, bit for bit.
/// Errors: INVALID_ARGUMENT (also for sizes of another mesh), CHECK_FAILED (the mesh has no valid doubles, as with
/// delotet_options_set_exact_form()), COORDINATE_RANGE, CANCELLED, STEINER_LIMIT, TETRAHEDRA_LIMIT, TIME_LIMIT,
/// MEMORY_LIMIT, TOO_LARGE, OUT_OF_MEMORY, INTERNAL.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_mesh_refine(
    mesh: *const DelotetMesh,
    sizes: *const DelotetMeshSizes,
    options: *const DelotetOptions,
    out_mesh: *mut *mut DelotetMesh,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes handles that nothing changes meanwhile, and NULL or valid out-parameters.
    unsafe {
        guard(out_error, || {
            let out = Out::new(out_mesh, "out_mesh")?;
            let mesh = get(mesh, "mesh")?;
            let none = MeshSizes::default();
            let sizes = sizes.as_ref().map_or(&none, |handle| &handle.sizes);
            let fine =
                with_settings(options, |options, control| refine_with(&mesh.mesh, sizes, options, control))?;
            let data = mesh.data.continued(&mesh.mesh, &fine)?;
            out.put(DelotetMesh::new(fine, data)?)
        })
    }
}

/// Improves the dihedral angles of a mesh, with the effort of delotet_options_set_optimize(), but at least 1, or for the seconds of
/// delotet_options_set_optimize_seconds(). The worst tetrahedron never gets worse. Kept is what delotet_mesh_refine() keeps: points inside of
/// earlier runs may move and go, and new ones may come.
/// `options`, `out_mesh`, errors: as for delotet_mesh_refine(); of the options those about sizes and shapes do not count.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_mesh_improve(
    mesh: *const DelotetMesh,
    options: *const DelotetOptions,
    out_mesh: *mut *mut DelotetMesh,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes handles that nothing changes meanwhile, and NULL or valid out-parameters.
    unsafe {
        guard(out_error, || {
            let out = Out::new(out_mesh, "out_mesh")?;
            let mesh = get(mesh, "mesh")?;
            let better =
                with_settings(options, |options, control| improve_with(&mesh.mesh, options, control))?;
            let data = mesh.data.continued(&mesh.mesh, &better)?;
            out.put(DelotetMesh::new(better, data)?)
        })
    }
}

/// Sizes without a wish. The caller owns them; free them with delotet_mesh_sizes_free(). NULL only if memory ran out.
#[no_mangle]
#[must_use]
pub extern "C" fn delotet_mesh_sizes_new() -> *mut DelotetMeshSizes {
    make(|| DelotetMeshSizes { sizes: MeshSizes::default() })
}

/// Sets the edge length wanted at each point of the mesh, replacing earlier ones. The smallest of all sizes counts, and they grow between the
/// points by the gradation (delotet_options_set_gradation()).
/// `sizes`: one per point, positive, infinite where there is no wish; copied; may be NULL if `count` is 0. `count`: the number of points of
/// the mesh that will be refined, or 0, which removes all. Errors: INVALID_ARGUMENT (a size is NaN or not positive; the number is compared
/// by delotet_mesh_refine()), OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_mesh_sizes_set_points(
    sizes: *mut DelotetMeshSizes,
    lengths: *const f64,
    count: usize,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes sizes that nothing else uses and an array of that size.
    unsafe {
        guard(out_error, || {
            let handle = get_mut(sizes, "sizes")?;
            handle.sizes.parts.points = positive(array(lengths, count, "lengths")?)?;
            Ok(())
        })
    }
}

/// Sets the edge length wanted in each tetrahedron of the mesh, replacing earlier ones: a point gets the smallest of those around it.
/// Otherwise as delotet_mesh_sizes_set_points(), with `count` the number of tetrahedra.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_mesh_sizes_set_tets(
    sizes: *mut DelotetMeshSizes,
    lengths: *const f64,
    count: usize,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes sizes that nothing else uses and an array of that size.
    unsafe {
        guard(out_error, || {
            let handle = get_mut(sizes, "sizes")?;
            handle.sizes.tets = positive(array(lengths, count, "lengths")?)?;
            Ok(())
        })
    }
}

/// A copy of lengths.
fn positive(lengths: &[f64]) -> Result<Vec<f64>, Error> {
    match lengths.iter().position(|&length| length.is_nan() || length <= 0.0) {
        Some(i) => Err(Error::new(
            Status::InvalidArgument,
            format_args!("lengths: {} at {i} is not positive", lengths[i]),
        )),
        None => Ok(fallible::copied(lengths)?),
    }
}

/// Sets the edge length wanted at the subfaces with a marker, replacing an earlier one. `length`: positive; infinite removes it. Errors:
/// INVALID_ARGUMENT, OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_mesh_sizes_set_facet(
    sizes: *mut DelotetMeshSizes,
    marker: i32,
    length: f64,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes sizes that nothing else uses.
    unsafe { guard(out_error, || get_mut(sizes, "sizes")?.sizes.parts.set_facets(marker, length)) }
}

/// Sets the area wanted of the subfaces with a marker, replacing an earlier one: the edge of the equilateral triangle of this area is wanted
/// there, unless the length is smaller. (Subfaces stay.) `area`: positive; infinite removes it. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_mesh_sizes_set_facet_area(
    sizes: *mut DelotetMeshSizes,
    marker: i32,
    area: f64,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes sizes that nothing else uses.
    unsafe { guard(out_error, || get_mut(sizes, "sizes")?.sizes.parts.set_facet_areas(marker, area)) }
}

/// Sets the edge length wanted at the subsegments with a marker; otherwise as delotet_mesh_sizes_set_facet().
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_mesh_sizes_set_segment(
    sizes: *mut DelotetMeshSizes,
    marker: i32,
    length: f64,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes sizes that nothing else uses.
    unsafe { guard(out_error, || get_mut(sizes, "sizes")?.sizes.parts.set_segments(marker, length)) }
}

/// Sets the edge length wanted in the regions with an attribute; otherwise as delotet_mesh_sizes_set_facet(). Errors: INVALID_ARGUMENT (also
/// for an attribute that is NaN), OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_mesh_sizes_set_region(
    sizes: *mut DelotetMeshSizes,
    attribute: f64,
    length: f64,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes sizes that nothing else uses.
    unsafe { guard(out_error, || get_mut(sizes, "sizes")?.sizes.parts.set_regions(attribute, length)) }
}

/// Frees sizes. NULL is ignored.
#[no_mangle]
pub unsafe extern "C" fn delotet_mesh_sizes_free(sizes: *mut DelotetMeshSizes) {
    // SAFETY: the caller passes NULL or sizes that nothing uses any more.
    unsafe { free(sizes) }
}

/// Handles may be passed between threads, and const ones shared.
const _: () = {
    const fn shareable<T: Send + Sync>() {}
    shareable::<DelotetMeshSizes>();
};
