//! TetGen's program, with its switches, files and exit codes: the C++ code in `src/tetgen`, on the C API like everybody else's.
#![allow(unsafe_code)]
use std::ffi::{c_char, c_int, CString, OsString};
use std::path::Path;
use std::process::ExitCode;

#[link(name = "delotet_tetgen", kind = "static")]
extern "C" {
    /// Runs the program on its arguments, without its name. `words` are `count` zero-terminated strings. Returns the exit code.
    fn delotet_tetgen_main(count: c_int, words: *const *const c_char) -> c_int;
}

/// Whether the program was called by a name such as `tetgen` or `tetgen1.5`.
pub fn is_called() -> bool {
    let name = std::env::args_os().next().unwrap_or_default();
    Path::new(&name).file_name().is_some_and(|name| name.to_string_lossy().starts_with("tetgen"))
}

/// Runs it on its arguments.
pub fn run(words: impl IntoIterator<Item = OsString>) -> ExitCode {
    // No argument of a program contains a zero.
    let words: Vec<CString> =
        words.into_iter().filter_map(|word| CString::new(word.into_encoded_bytes()).ok()).collect();
    let pointers: Vec<*const c_char> = words.iter().map(|word| word.as_ptr()).collect();
    let count = c_int::try_from(pointers.len()).unwrap_or(0);
    // SAFETY: `pointers` has `count` zero-terminated strings, which outlive the call; the function throws nothing.
    let code = unsafe { delotet_tetgen_main(count, pointers.as_ptr()) };
    ExitCode::from(u8::try_from(code).unwrap_or(1))
}
