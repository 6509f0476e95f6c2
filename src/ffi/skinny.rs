//! Tetrahedra above a radius-edge ratio, and what of the input forces them.
use crate::error::Error;
use crate::ffi::error::DelotetError;
use crate::ffi::guard::{free, get, guard, read, Out};
use crate::ffi::mesh::DelotetMesh;
use crate::ffi::status::{name_in, DelotetStatus};
use crate::ffi::view::{records, same_layout};
use crate::query::quality::skinny_tets;
use crate::query::{SkinnyCause, SkinnyTet, SkinnyTets};
use libc::c_char;
use std::mem::offset_of;

/// Why a tetrahedron is above a radius-edge ratio: one of the DELOTET_SKINNY_ constants. Of several causes the one with the smallest number
/// counts. Later versions may add causes.
pub type DelotetSkinnyCause = u32;
/// Input-forced: in a narrow wedge between two facets (delotet_mesh_forced_tets()).
pub const DELOTET_SKINNY_WEDGE: DelotetSkinnyCause = 0;
/// Input-forced: a face of it is in a corner of a facet (from one subsegment to the next around a point) of less than arcsin(1 / (2 ratio)):
/// every mesh of this input has tetrahedra above the ratio there.
pub const DELOTET_SKINNY_CORNER: DelotetSkinnyCause = 1;
/// Input-forced: a face of it is a triangle of a surface that is kept, and above the ratio itself.
pub const DELOTET_SKINNY_FACE: DelotetSkinnyCause = 2;
/// It has a point in common with an input-forced tetrahedron.
pub const DELOTET_SKINNY_BESIDE: DelotetSkinnyCause = 3;
/// None of these.
pub const DELOTET_SKINNY_OTHER: DelotetSkinnyCause = 4;
const _: () = assert!(DELOTET_SKINNY_WEDGE == SkinnyCause::Wedge as u32);
const _: () = assert!(DELOTET_SKINNY_CORNER == SkinnyCause::Corner as u32);
const _: () = assert!(DELOTET_SKINNY_FACE == SkinnyCause::Face as u32);
const _: () = assert!(DELOTET_SKINNY_BESIDE == SkinnyCause::Beside as u32);
const _: () = assert!(DELOTET_SKINNY_OTHER == SkinnyCause::Other as u32);

/// The tetrahedra of a mesh above a radius-edge ratio: immutable, so any number of threads may read it.
pub struct DelotetSkinnyTets {
    tets: SkinnyTets,
}

/// A tetrahedron above a radius-edge ratio.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetSkinnyTet {
    /// The tetrahedron.
    pub tet: u32,
    /// Why it is one: a DELOTET_SKINNY_ constant.
    pub cause: DelotetSkinnyCause,
    /// The input facets that force it, the smaller index first; twice the same if it is one. With DELOTET_SKINNY_BESIDE those that force
    /// what it is beside, with DELOTET_SKINNY_OTHER both are DELOTET_INVALID_INDEX.
    pub facets: [u32; 2],
    /// Its circumradius over its shortest edge.
    pub radius_edge: f64,
}

/// Borrowed tetrahedra above a radius-edge ratio; NULL and 0 if there are none.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetSkinnyTetsView {
    /// The first of `count` records; DELOTET_AT(DelotetSkinnyTet, view, i) is the i-th.
    pub first: *const DelotetSkinnyTet,
    /// Number of elements.
    pub count: usize,
    /// Bytes from one element to the next.
    pub stride: usize,
}
records!(DelotetSkinnyTetsView, DelotetSkinnyTet, SkinnyTet);
same_layout!(
    DelotetSkinnyTet,
    SkinnyTet,
    tet = tet,
    cause = cause,
    facets = facets,
    radius_edge = radius_edge
);

/// Finds the tetrahedra whose circumradius is more than `ratio` of their shortest edge, and for each whether the input forces it.
/// `ratio`: positive and finite; 0 is the ratio that was asked for (delotet_options_set_quality()), or 2 if none was, as in meshes that were
/// read. `out_tets`: the list, owned by the caller, which needs the mesh no longer; free it with delotet_skinny_tets_free(). NULL on failure.
/// Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_skinny_tets_new(
    mesh: *const DelotetMesh,
    ratio: f64,
    out_tets: *mut *mut DelotetSkinnyTets,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a mesh that is alive, and NULL or valid out-parameters.
    unsafe {
        guard(out_error, || {
            let out = Out::new(out_tets, "out_tets")?;
            let mesh = get(mesh, "mesh")?;
            out.put(DelotetSkinnyTets { tets: of_mesh(mesh, ratio)? })
        })
    }
}

fn of_mesh(mesh: &DelotetMesh, ratio: f64) -> Result<SkinnyTets, Error> {
    skinny_tets(&mesh.mesh, (ratio != 0.0).then_some(ratio), mesh.forced_tets()?)
}

/// All of them, in ascending order. Borrowed from `tets`. Empty for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_skinny_tets_view(tets: *const DelotetSkinnyTets) -> DelotetSkinnyTetsView {
    let none = DelotetSkinnyTetsView::new(&[]);
    // SAFETY: the caller passes NULL or a list that is alive.
    unsafe { read(tets, none, |tets| DelotetSkinnyTetsView::new(&tets.tets.list)) }
}

/// The ratio that they are above. 0 for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_skinny_tets_ratio(tets: *const DelotetSkinnyTets) -> f64 {
    // SAFETY: the caller passes NULL or a list that is alive.
    unsafe { read(tets, 0.0, |tets| tets.tets.ratio) }
}

/// Frees a list. NULL is ignored.
#[no_mangle]
pub unsafe extern "C" fn delotet_skinny_tets_free(tets: *mut DelotetSkinnyTets) {
    // SAFETY: the caller passes NULL or a list that nothing uses any more.
    unsafe { free(tets) }
}

static CAUSE_NAMES: &[(u32, &str)] = &[
    (0, "DELOTET_SKINNY_WEDGE\0"),
    (1, "DELOTET_SKINNY_CORNER\0"),
    (2, "DELOTET_SKINNY_FACE\0"),
    (3, "DELOTET_SKINNY_BESIDE\0"),
    (4, "DELOTET_SKINNY_OTHER\0"),
];

/// Name of a cause, such as "DELOTET_SKINNY_WEDGE"; "unknown" for other numbers. Static: never NULL, never freed.
#[no_mangle]
pub extern "C" fn delotet_skinny_cause_name(cause: DelotetSkinnyCause) -> *const c_char {
    name_in(CAUSE_NAMES, cause)
}

/// Handles may be passed between threads, and const ones shared.
const _: () = {
    const fn shareable<T: Send + Sync>() {}
    shareable::<DelotetSkinnyTets>();
};
