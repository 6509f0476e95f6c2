//! Owned error objects that list all defects.
use crate::error::{Defect, Error};
use crate::fallible;
use crate::ffi::guard::{boxed, free, read};
use crate::ffi::status::{DelotetDefectKind, DelotetElement, DelotetStatus};
use crate::ffi::view::records;
use libc::c_char;
use std::collections::TryReserveError;

/// A failure: its status, a readable message, and all elements at fault. Created by the failing call, owned by the caller.
pub struct DelotetError {
    status: DelotetStatus,
    /// Ends with a zero byte. Empty if there was no memory for the text.
    message: Vec<u8>,
    defects: Vec<DelotetDefect>,
    defect_count: usize,
}

/// One defect: kind, the one or two elements involved, and a point that locates it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DelotetDefect {
    /// The kind: a DelotetDefectKind, stored as 32 bits with every compiler.
    pub kind: u32,
    /// What kind of element `first` is: a DelotetElement.
    pub first_element: u32,
    /// Index of the element at fault.
    pub first: u32,
    /// What kind of element `second` is: a DelotetElement, DELOTET_ELEMENT_NONE if only one element is involved.
    pub second_element: u32,
    /// Index of the other element of a pair, or DELOTET_INVALID_INDEX.
    pub second: u32,
    /// 1 if `point` is set, else 0.
    pub has_point: u32,
    /// x y z of a point at or near the defect (rounded where it is an intersection); zeros if there is none.
    pub point: [f64; 3],
}

/// Borrowed defects; NULL and 0 if there are none.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetDefectsView {
    /// The first of `count` defects; DELOTET_AT(DelotetDefect, view, i) is the i-th.
    pub first: *const DelotetDefect,
    /// Number of elements.
    pub count: usize,
    /// Bytes from one element to the next.
    pub stride: usize,
}
records!(DelotetDefectsView, DelotetDefect, DelotetDefect);

impl From<&Defect> for DelotetDefect {
    fn from(defect: &Defect) -> Self {
        let (first_element, first) = DelotetElement::split(Some(defect.first));
        let (second_element, second) = DelotetElement::split(defect.second);
        DelotetDefect {
            kind: DelotetDefectKind::from(defect.kind) as u32,
            first_element: first_element as u32,
            first,
            second_element: second_element as u32,
            second,
            has_point: u32::from(defect.point.is_some()),
            point: defect.point.unwrap_or_default(),
        }
    }
}

/// Returned to the caller when there is no memory for an error object. Never freed.
static OUT_OF_MEMORY: DelotetError = DelotetError {
    status: DelotetStatus::OutOfMemory,
    message: Vec::new(),
    defects: Vec::new(),
    defect_count: 0,
};

impl DelotetError {
    /// An owned error handle for the caller; `status` is the error's. If there is no memory for it, the error is OUT_OF_MEMORY instead.
    pub(super) fn new(error: Error, status: &mut DelotetStatus) -> *mut DelotetError {
        let made = DelotetError::try_new(error).ok().and_then(|error| boxed(error).ok());
        match made {
            Some(error) => Box::into_raw(error),
            None => {
                *status = DelotetStatus::OutOfMemory;
                (&raw const OUT_OF_MEMORY).cast_mut()
            }
        }
    }

    fn try_new(error: Error) -> Result<DelotetError, TryReserveError> {
        // When memory is short, the defects are dropped rather than the message.
        let defects = fallible::collect(error.defects.iter().map(DelotetDefect::from)).unwrap_or_default();
        Ok(DelotetError {
            status: DelotetStatus::from(error.status),
            message: c_text(&error.message)?,
            defects,
            defect_count: error.defect_count,
        })
    }
}

/// A C string: zero-terminated; zero bytes in the text become blanks.
pub(super) fn c_text(text: &str) -> Result<Vec<u8>, TryReserveError> {
    fallible::collect(text.bytes().map(|byte| if byte == 0 { b' ' } else { byte }).chain([0]))
}

/// The status of `error`, the same as the failing call returned; DELOTET_STATUS_OK for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_error_status(error: *const DelotetError) -> DelotetStatus {
    // SAFETY: the caller passes NULL or an error that is alive.
    unsafe { read(error, DelotetStatus::Ok, |error| error.status) }
}

/// The message: one line of English, UTF-8. Borrowed from `error`: valid until it is freed. "" for NULL; never NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_error_message(error: *const DelotetError) -> *const c_char {
    // SAFETY: the caller passes NULL or an error that is alive.
    unsafe {
        read(error, c"".as_ptr(), |error| match error.message.as_slice() {
            [] => c"out of memory".as_ptr(),
            text => text.as_ptr().cast(),
        })
    }
}

/// The defects that the error lists, at most as many as delotet_options_set_max_defects() allows. Borrowed from `error`: valid until it is
/// freed. Empty for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_error_defects(error: *const DelotetError) -> DelotetDefectsView {
    // SAFETY: the caller passes NULL or an error that is alive.
    unsafe { read(error, DelotetDefectsView::new(&[]), |error| DelotetDefectsView::new(&error.defects)) }
}

/// The number of defects found; the error may list fewer. 0 for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_error_defect_count(error: *const DelotetError) -> usize {
    // SAFETY: the caller passes NULL or an error that is alive.
    unsafe { read(error, 0, |error| error.defect_count) }
}

/// Frees an error and everything borrowed from it. NULL is ignored.
#[no_mangle]
pub unsafe extern "C" fn delotet_error_free(error: *mut DelotetError) {
    if std::ptr::eq(error, &OUT_OF_MEMORY) {
        return;
    }
    // SAFETY: the caller passes NULL or an error that it owns.
    unsafe { free(error) }
}
