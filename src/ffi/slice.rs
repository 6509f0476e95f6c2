//! Arrays from C. (NULL, 0) is the empty array, for which `from_raw_parts` would be undefined behaviour.
use crate::error::Error;
use crate::ffi::guard::{invalid, null};

/// The `count` elements at `pointer`. Fails if the pointer is null (and `count` is not 0) or misaligned, or the array exceeds the address
/// space.
///
/// # Safety
/// `pointer` is valid for reads of `count` elements during `'a`, unless `count` is 0.
pub(super) unsafe fn array<'a, T>(pointer: *const T, count: usize, name: &str) -> Result<&'a [T], Error> {
    if count == 0 {
        return Ok(&[]);
    }
    if pointer.is_null() {
        return Err(null(name));
    }
    check(pointer, count, name)?;
    // SAFETY: not null, aligned, not too large, and the caller promises the rest.
    Ok(unsafe { std::slice::from_raw_parts(pointer, count) })
}

/// Like [`array`], for an array to be written.
///
/// # Safety
/// As for [`array`], for writes too, and nothing else uses the array during `'a`.
pub(super) unsafe fn array_mut<'a, T>(
    pointer: *mut T,
    count: usize,
    name: &str,
) -> Result<&'a mut [T], Error> {
    if count == 0 {
        return Ok(&mut []);
    }
    if pointer.is_null() {
        return Err(null(name));
    }
    check(pointer, count, name)?;
    // SAFETY: not null, aligned, not too large, and the caller promises the rest.
    Ok(unsafe { std::slice::from_raw_parts_mut(pointer, count) })
}

/// Like [`array`], where null means "not given".
///
/// # Safety
/// As for [`array`].
pub(super) unsafe fn optional<'a, T>(
    pointer: *const T,
    count: usize,
    name: &str,
) -> Result<Option<&'a [T]>, Error> {
    if pointer.is_null() {
        return Ok(None);
    }
    // SAFETY: the caller's promise is the same.
    unsafe { array(pointer, count, name) }.map(Some)
}

fn check<T>(pointer: *const T, count: usize, name: &str) -> Result<(), Error> {
    let bytes = count.checked_mul(size_of::<T>()).filter(|&bytes| bytes <= isize::MAX as usize);
    if bytes.is_none() {
        return Err(invalid(format_args!("{name}: {count} elements do not fit into memory")));
    }
    if pointer as usize % align_of::<T>() != 0 {
        return Err(invalid(format_args!("{name} is misaligned")));
    }
    Ok(())
}
