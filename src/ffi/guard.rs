//! The boundary between C and Rust: no panic crosses it, no null pointer gets in.
use crate::error::{Error, Message, Status};
use crate::ffi::error::DelotetError;
use crate::ffi::status::DelotetStatus;
use crate::panics::catch_silently;
use std::alloc::Layout;

/// Runs the body of a fallible exported function. `*out_error` is null on success and an owned error on failure; a null `out_error` means
/// that the caller only wants the status.
///
/// # Safety
/// `out_error` is null or valid for one write.
pub(super) unsafe fn guard(
    out_error: *mut *mut DelotetError,
    body: impl FnOnce() -> Result<(), Error>,
) -> DelotetStatus {
    let error = catch_silently(body).and_then(|result| result).err();
    let mut status = error.as_ref().map_or(DelotetStatus::Ok, |error| DelotetStatus::from(error.status));
    if !out_error.is_null() {
        let handle = match error {
            Some(error) => DelotetError::new(error, &mut status),
            None => std::ptr::null_mut(),
        };
        // SAFETY: not null, and the caller promises that it is valid for a write.
        unsafe { out_error.write(handle) };
    }
    status
}

/// The result of `body` for a handle, `otherwise` if the handle is null.
///
/// # Safety
/// `handle` is null or valid for reads as long as the result is used.
pub(super) unsafe fn read<'a, T: 'a, R>(handle: *const T, otherwise: R, body: impl FnOnce(&'a T) -> R) -> R {
    // SAFETY: the caller promises that a handle that is not null is valid.
    match unsafe { handle.as_ref() } {
        Some(handle) => match catch_silently(|| body(handle)) {
            Ok(result) => result,
            Err(_) => otherwise,
        },
        None => otherwise,
    }
}

/// Moves a value to the heap, or returns it if memory ran out: `Box::new` would abort the process.
pub(super) fn boxed<T>(value: T) -> Result<Box<T>, T> {
    let layout = Layout::new::<T>();
    if layout.size() == 0 {
        #[expect(clippy::disallowed_methods, reason = "a value without size takes no memory")]
        return Ok(Box::new(value));
    }
    // SAFETY: the size is not 0.
    let room = unsafe { std::alloc::alloc(layout) }.cast::<T>();
    if room.is_null() {
        return Err(value);
    }
    // SAFETY: room for one T from the allocator that Box frees with, filled here.
    Ok(unsafe {
        room.write(value);
        Box::from_raw(room)
    })
}

/// Creates an owned handle; null if memory runs out.
pub(super) fn make<T>(body: impl FnOnce() -> T) -> *mut T {
    match catch_silently(|| boxed(body())) {
        Ok(Ok(handle)) => Box::into_raw(handle),
        _ => std::ptr::null_mut(),
    }
}

/// Frees an owned handle; null is ignored.
///
/// # Safety
/// `handle` is null or came from this library and was not freed before.
pub(super) unsafe fn free<T>(handle: *mut T) {
    if !handle.is_null() {
        // SAFETY: every handle of ours was made by Box::into_raw; the caller gives it up.
        let _ = catch_silently(|| drop(unsafe { Box::from_raw(handle) }));
    }
}

/// The handle behind a pointer, or an error that names the argument.
///
/// # Safety
/// `handle` is null or valid for reads during `'a`.
pub(super) unsafe fn get<'a, T>(handle: *const T, name: &str) -> Result<&'a T, Error> {
    // SAFETY: the caller promises that a handle that is not null is valid.
    unsafe { handle.as_ref() }.ok_or_else(|| null(name))
}

/// As [`get`], for a handle that is changed.
///
/// # Safety
/// `handle` is null or valid for reads and writes during `'a`, and nothing else uses it.
pub(super) unsafe fn get_mut<'a, T>(handle: *mut T, name: &str) -> Result<&'a mut T, Error> {
    // SAFETY: the caller promises that a handle that is not null is valid and not shared.
    unsafe { handle.as_mut() }.ok_or_else(|| null(name))
}

/// An out-parameter for an owned handle: null from the start, set to the handle by [`Out::put`].
pub(super) struct Out<T>(*mut *mut T);

impl<T> Out<T> {
    /// # Safety
    /// `pointer` is null or valid for writes until the last use of the result.
    pub(super) unsafe fn new(pointer: *mut *mut T, name: &str) -> Result<Out<T>, Error> {
        if pointer.is_null() {
            return Err(null(name));
        }
        // SAFETY: not null, and the caller promises that it is valid for writes.
        unsafe { pointer.write(std::ptr::null_mut()) };
        Ok(Out(pointer))
    }

    /// Hands the value over to the caller.
    pub(super) fn put(self, value: T) -> Result<(), Error> {
        let Ok(handle) = boxed(value) else {
            return Err(Error::new(Status::OutOfMemory, "out of memory"));
        };
        // SAFETY: checked and promised in `new`.
        unsafe { self.0.write(Box::into_raw(handle)) };
        Ok(())
    }
}

/// Writes a plain value through an out-parameter.
///
/// # Safety
/// `pointer` is null or valid for one write.
pub(super) unsafe fn set<T: Copy>(pointer: *mut T, value: T, name: &str) -> Result<(), Error> {
    if pointer.is_null() {
        return Err(null(name));
    }
    // SAFETY: not null, and the caller promises that it is valid for a write.
    unsafe { pointer.write(value) };
    Ok(())
}

/// The error for a null argument.
pub(super) fn null(name: &str) -> Error {
    Error::new(Status::InvalidArgument, format_args!("{name} is null"))
}

/// The error for an argument outside its range.
pub(super) fn invalid(message: impl Into<Message>) -> Error {
    Error::new(Status::InvalidArgument, message)
}
