//! What stands between C and Rust: no panic leaves, no null pointer enters.
use super::error::DelotetError;
use super::status::DelotetStatus;
use crate::error::{Error, Status};
use std::cell::{Cell, RefCell};
use std::panic::{catch_unwind, AssertUnwindSafe};
use std::sync::Once;

#[cfg(panic = "abort")]
compile_error!("delotet turns panics into a status: build it with panic = \"unwind\"");

thread_local! {
    /// This thread is inside a call from C: the panic hook stays silent and keeps the text.
    static INSIDE: Cell<bool> = const { Cell::new(false) };
    static PANIC_TEXT: RefCell<String> = const { RefCell::new(String::new()) };
}

static HOOK: Once = Once::new();

/// Installs, once, a panic hook that keeps the text of panics inside our calls and passes on all others.
fn install_hook() {
    HOOK.call_once(|| {
        let previous = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |info| {
            if INSIDE.try_with(Cell::get).unwrap_or(false) {
                let text = info.to_string().replace('\n', " ");
                let _ = PANIC_TEXT.try_with(|slot| slot.try_borrow_mut().map(|mut slot| *slot = text));
            } else {
                previous(info);
            }
        }));
    });
}

/// Runs `body`; a panic in it becomes its text.
fn catch<R>(body: impl FnOnce() -> R) -> Result<R, String> {
    install_hook();
    let outer = INSIDE.replace(true);
    let result = catch_unwind(AssertUnwindSafe(body));
    INSIDE.set(outer);
    result.map_err(|payload| {
        // Dropping a payload may run arbitrary code; ours are strings, but nothing may unwind from here.
        std::mem::forget(payload);
        PANIC_TEXT.with(|slot| std::mem::take(&mut *slot.borrow_mut()))
    })
}

/// Runs the body of a fallible exported function. `*out_error` is null on success and an owned error on failure; a null
/// `out_error` means that the caller wants the status only.
///
/// # Safety
/// `out_error` is null or valid for one write.
pub(super) unsafe fn guard(
    out_error: *mut *mut DelotetError,
    body: impl FnOnce() -> Result<(), Error>,
) -> DelotetStatus {
    let error = match catch(body) {
        Ok(Ok(())) => None,
        Ok(Err(error)) => Some(error),
        Err(text) => Some(Error::internal(format!("internal error, please report it: {text}"))),
    };
    let status = error.as_ref().map_or(DelotetStatus::Ok, |error| error.status.into());
    if !out_error.is_null() {
        let handle = match error {
            Some(error) => DelotetError::new(error),
            None => std::ptr::null_mut(),
        };
        // SAFETY: not null, and the caller promises that it is valid for a write.
        unsafe { out_error.write(handle) };
    }
    status
}

/// Reads something of a handle: `otherwise` if the handle is null.
///
/// # Safety
/// `handle` is null or valid for reads as long as the result is used.
pub(super) unsafe fn read<'a, T: 'a, R>(handle: *const T, otherwise: R, body: impl FnOnce(&'a T) -> R) -> R {
    // SAFETY: the caller promises that a handle that is not null is valid.
    match unsafe { handle.as_ref() } {
        Some(handle) => match catch(|| body(handle)) {
            Ok(result) => result,
            Err(_) => otherwise,
        },
        None => otherwise,
    }
}

/// Makes an owned handle, null if the body fails.
pub(super) fn make<T>(body: impl FnOnce() -> T) -> *mut T {
    catch(|| Box::into_raw(Box::new(body()))).unwrap_or(std::ptr::null_mut())
}

/// Frees an owned handle; null is ignored.
///
/// # Safety
/// `handle` is null or came from this library and was not freed before.
pub(super) unsafe fn free<T>(handle: *mut T) {
    if !handle.is_null() {
        // SAFETY: every handle of ours was made by Box::into_raw; the caller gives it up.
        let _ = catch(|| drop(unsafe { Box::from_raw(handle) }));
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

/// An out-parameter for an owned handle: set to null at once, to a handle by [`Out::put`].
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
    pub(super) fn put(self, value: T) {
        // SAFETY: checked and promised in `new`.
        unsafe { self.0.write(Box::into_raw(Box::new(value))) };
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
    Error::new(Status::InvalidArgument, format!("{name} is null"))
}

/// The error for an argument outside its range.
pub(super) fn invalid(message: impl Into<String>) -> Error {
    Error::new(Status::InvalidArgument, message)
}
