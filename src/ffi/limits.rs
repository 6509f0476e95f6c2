//! What ends a run: tokens, and the limits among the options.
use crate::control::Limits;
use crate::error::Error;
use crate::ffi::error::DelotetError;
use crate::ffi::guard::{free, invalid, make, read};
use crate::ffi::options::{change, setting, DelotetOptions};
use crate::ffi::status::DelotetStatus;
use std::ptr::NonNull;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Duration;

/// Cancels runs from any thread: one token may be given to the options of any number of runs. Functions that take `const` tokens may be
/// called at any time, concurrently with the runs and with each other. Options keep the token alive: it may be freed while they use it.
pub struct DelotetCancelToken {
    flag: AtomicBool,
    /// The caller and the options that have it.
    owners: AtomicUsize,
}

/// The part of options in a token: the last one to let go frees it. (An `Arc` would abort the process if memory ran out.)
pub(super) struct Shared(NonNull<DelotetCancelToken>);

// SAFETY: a token has only atomic fields.
unsafe impl Send for Shared {}
// SAFETY: as above.
unsafe impl Sync for Shared {}

impl Shared {
    /// A part in a token; `None` for null.
    ///
    /// # Safety
    /// `token` is null or valid.
    pub(super) unsafe fn new(token: *const DelotetCancelToken) -> Option<Shared> {
        let token = NonNull::new(token.cast_mut())?;
        // SAFETY: not null, and the caller promises that it is valid.
        unsafe { token.as_ref() }.owners.fetch_add(1, Ordering::Relaxed);
        Some(Shared(token))
    }

    /// Another part in the same token.
    pub(super) fn share(&self) -> Shared {
        // SAFETY: this part keeps it alive.
        unsafe { self.0.as_ref() }.owners.fetch_add(1, Ordering::Relaxed);
        Shared(self.0)
    }

    /// Ends the part of the caller of [`delotet_cancel_token_new`].
    ///
    /// # Safety
    /// `token` is null or a token that the caller owns.
    unsafe fn free(token: *mut DelotetCancelToken) {
        drop(NonNull::new(token).map(Shared));
    }

    /// The token.
    pub(super) fn as_ptr(&self) -> *const DelotetCancelToken {
        self.0.as_ptr()
    }

    /// Set once the token is cancelled.
    pub(super) fn flag(&self) -> &AtomicBool {
        // SAFETY: this part keeps it alive.
        &unsafe { self.0.as_ref() }.flag
    }
}

impl Drop for Shared {
    fn drop(&mut self) {
        // SAFETY: this part keeps it alive. What others did with the token comes before it is freed.
        if unsafe { self.0.as_ref() }.owners.fetch_sub(1, Ordering::AcqRel) == 1 {
            // SAFETY: made by `boxed`, and nobody else has a part in it.
            unsafe { free(self.0.as_ptr()) };
        }
    }
}

/// A new token, not cancelled. The caller owns it; free it with delotet_cancel_token_free(). NULL only if memory ran out.
#[no_mangle]
#[must_use]
pub extern "C" fn delotet_cancel_token_new() -> *mut DelotetCancelToken {
    make(|| DelotetCancelToken { flag: AtomicBool::new(false), owners: AtomicUsize::new(1) })
}

/// Cancels all runs that use the token, also those that begin later: they fail with DELOTET_STATUS_CANCELLED within a fraction of a second.
/// Returns at once; takes no lock and allocates nothing, so that signal handlers may call it. NULL is ignored.
#[no_mangle]
pub unsafe extern "C" fn delotet_cancel_token_cancel(token: *const DelotetCancelToken) {
    // SAFETY: the caller passes NULL or a valid token.
    if let Some(token) = unsafe { token.as_ref() } {
        token.flag.store(true, Ordering::Relaxed);
    }
}

/// Whether the token is cancelled; false for NULL.
#[no_mangle]
pub unsafe extern "C" fn delotet_cancel_token_is_cancelled(token: *const DelotetCancelToken) -> bool {
    // SAFETY: the caller passes NULL or a valid token.
    unsafe { read(token, false, |token| token.flag.load(Ordering::Relaxed)) }
}

/// Makes the token usable again. A run that has not yet seen that it was cancelled goes on. NULL is ignored.
#[no_mangle]
pub unsafe extern "C" fn delotet_cancel_token_reset(token: *const DelotetCancelToken) {
    // SAFETY: the caller passes NULL or a valid token.
    unsafe { read(token, (), |token| token.flag.store(false, Ordering::Relaxed)) }
}

/// Gives up the caller's part in a token, which must not be used by the caller any more. Options that have it keep it until they are freed
/// or get another one. NULL is ignored.
#[no_mangle]
pub unsafe extern "C" fn delotet_cancel_token_free(token: *mut DelotetCancelToken) {
    // SAFETY: the caller passes NULL or a token that it owns; its part in it ends here.
    unsafe { Shared::free(token) }
}

/// Sets the token that cancels runs with these options. NULL, the default: none. Errors: INVALID_ARGUMENT (options is NULL).
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_options_set_cancel_token(
    options: *mut DelotetOptions,
    token: *const DelotetCancelToken,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, NULL or a valid token, and NULL or a valid out-parameter.
    unsafe {
        change(options, out_error, |options| {
            options.cancel = Shared::new(token);
            Ok(())
        })
    }
}

/// The token, NULL if there is none, as set by delotet_options_set_cancel_token(). Borrowed from `options`: valid until they get another
/// one or are freed.
#[no_mangle]
pub unsafe extern "C" fn delotet_options_cancel_token(
    options: *const DelotetOptions,
) -> *const DelotetCancelToken {
    let none = std::ptr::null();
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile.
    unsafe { read(options, none, |options| options.cancel.as_ref().map_or(none, Shared::as_ptr)) }
}

/// Fail with DELOTET_STATUS_TIME_LIMIT this many seconds after the beginning of a call. 0, the default: no limit. Errors: INVALID_ARGUMENT
/// (negative or not finite).
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_options_set_time_limit(
    options: *mut DelotetOptions,
    seconds: f64,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, and NULL or a valid out-parameter.
    unsafe {
        change(options, out_error, |options| {
            options.options.time_limit = time_limit(seconds)?;
            Ok(())
        })
    }
}

/// The limit on time in seconds, 0 if there is none, as set by delotet_options_set_time_limit().
#[no_mangle]
pub unsafe extern "C" fn delotet_options_time_limit(options: *const DelotetOptions) -> f64 {
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile.
    unsafe { setting(options, |options| seconds(options.time_limit)) }
}

/// Fail with DELOTET_STATUS_MEMORY_LIMIT before the resident memory of the process has grown by more than this many bytes since the
/// beginning of a call. Concurrent calls and the host's other threads count, since only the whole process is measured. What is
/// taken between two readings may exceed it. Linux only: other systems count only the large tables of the engine. 0, the default: no limit.
/// Errors: INVALID_ARGUMENT (NULL).
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_options_set_memory_limit(
    options: *mut DelotetOptions,
    bytes: u64,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, and NULL or a valid out-parameter.
    unsafe {
        change(options, out_error, |options| {
            options.options.memory_limit = (bytes > 0).then_some(bytes);
            Ok(())
        })
    }
}

/// The limit on memory in bytes, 0 if there is none, as set by delotet_options_set_memory_limit().
#[no_mangle]
pub unsafe extern "C" fn delotet_options_memory_limit(options: *const DelotetOptions) -> u64 {
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile.
    unsafe { setting(options, |options| options.memory_limit.unwrap_or(0)) }
}

/// Fail with DELOTET_STATUS_TETRAHEDRA_LIMIT once the mesh has more tetrahedra than this: while it is filled, refined or optimised, or in the
/// end. UINT64_MAX, the default: no limit. Errors: INVALID_ARGUMENT (NULL).
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_options_set_tetrahedra_limit(
    options: *mut DelotetOptions,
    limit: u64,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes NULL or options that nothing else uses, and NULL or a valid out-parameter.
    unsafe {
        change(options, out_error, |options| {
            options.options.tetrahedra_limit = (limit != u64::MAX).then_some(limit);
            Ok(())
        })
    }
}

/// The limit on tetrahedra, UINT64_MAX if there is none, as set by delotet_options_set_tetrahedra_limit().
#[no_mangle]
pub unsafe extern "C" fn delotet_options_tetrahedra_limit(options: *const DelotetOptions) -> u64 {
    // SAFETY: the caller passes NULL or options that nothing changes meanwhile.
    unsafe { setting(options, |options| options.tetrahedra_limit.unwrap_or(u64::MAX)) }
}

/// A limit given in seconds, 0 for none.
pub(super) fn time_limit(seconds: f64) -> Result<Option<Duration>, Error> {
    if !seconds.is_finite() || seconds < 0.0 {
        return Err(invalid(format_args!("time_limit: {seconds} is no number of seconds")));
    }
    let limit = Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX);
    Ok((seconds > 0.0).then_some(limit.max(Duration::from_nanos(1))))
}

/// A limit in seconds, 0 for none.
pub(super) fn seconds(limit: Option<Duration>) -> f64 {
    limit.map_or(0.0, |limit| limit.as_secs_f64())
}

/// The same limits with the token of a handle.
pub(super) fn with_token<'a>(limits: Limits<'a>, cancel: &'a Option<Shared>) -> Limits<'a> {
    Limits { cancel: cancel.as_ref().map(Shared::flag), ..limits }
}
