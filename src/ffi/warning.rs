//! Warnings: what a caller should know about a mesh that is valid nonetheless.
use crate::ffi::guard::read;
use crate::ffi::mesh::DelotetMesh;
use crate::ffi::status::{DelotetElement, DelotetWarningKind};
use crate::ffi::view::records;
use crate::warning::{Warning, WarningKind};

/// One warning: kind, the one or two elements involved, and a point that locates it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DelotetWarning {
    /// The kind: a DelotetWarningKind, stored as 32 bits with every compiler.
    pub kind: u32,
    /// What kind of element `first` is: a DelotetElement.
    pub first_element: u32,
    /// Index of the element that the warning is about.
    pub first: u32,
    /// What kind of element `second` is: a DelotetElement, DELOTET_ELEMENT_NONE if only one element is involved.
    pub second_element: u32,
    /// Index of the other element of a pair, or DELOTET_INVALID_INDEX.
    pub second: u32,
    /// 1 if `point` is set, else 0.
    pub has_point: u32,
    /// x y z of a point at or near the element (rounded); zeros if there is none.
    pub point: [f64; 3],
}

/// Borrowed warnings; NULL and 0 if there are none.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetWarningsView {
    /// The first of `count` warnings; DELOTET_AT(DelotetWarning, view, i) is the i-th.
    pub first: *const DelotetWarning,
    /// Number of elements.
    pub count: usize,
    /// Bytes from one element to the next.
    pub stride: usize,
}
records!(DelotetWarningsView, DelotetWarning, DelotetWarning);

impl From<&Warning> for DelotetWarning {
    fn from(warning: &Warning) -> Self {
        let (first_element, first) = DelotetElement::split(Some(warning.first));
        let (second_element, second) = DelotetElement::split(warning.second);
        DelotetWarning {
            kind: DelotetWarningKind::from(warning.kind) as u32,
            first_element: first_element as u32,
            first,
            second_element: second_element as u32,
            second,
            has_point: u32::from(warning.point.is_some()),
            point: warning.point.unwrap_or_default(),
        }
    }
}

/// The warnings about a mesh: leaks, parts of the input that are not meshed, seeds without effect. Lists at most as many of each kind as
/// delotet_options_set_max_defects() allows; delotet_mesh_warning_count() counts all. The log gets a line per kind. Borrowed from `mesh`.
/// Empty for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_mesh_warnings(mesh: *const DelotetMesh) -> DelotetWarningsView {
    let none = DelotetWarningsView::new(&[]);
    // SAFETY: the caller passes NULL or a mesh that is alive.
    unsafe { read(mesh, none, |mesh| DelotetWarningsView::new(&mesh.warnings)) }
}

/// The number of warnings of a kind (a DelotetWarningKind), listed or not. 0 for NULL and for unknown kinds.
#[no_mangle]
pub unsafe extern "C" fn delotet_mesh_warning_count(mesh: *const DelotetMesh, kind: u32) -> u64 {
    let known = WarningKind::ALL.into_iter().find(|&known| DelotetWarningKind::from(known) as u32 == kind);
    // SAFETY: the caller passes NULL or a mesh that is alive.
    unsafe { read(mesh, 0, |mesh| known.map_or(0, |kind| mesh.mesh.warnings.count(kind))) }
}
