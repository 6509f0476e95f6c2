//! Version of the loaded library.
use libc::c_char;

/// The text that `delotet_version_string` returns.
static VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), "\0");

const fn part(text: &str) -> u32 {
    let bytes = text.as_bytes();
    let mut value = 0;
    let mut index = 0;
    while index < bytes.len() {
        value = value * 10 + (bytes[index] - b'0') as u32;
        index += 1;
    }
    value
}

/// Version of the loaded library: 1,000,000 * major + 1,000 * minor + patch, like DELOTET_VERSION for the header. Before 1.0, library and
/// header must agree in major and minor version. May be called from any thread at any time; cannot fail.
#[no_mangle]
pub extern "C" fn delotet_version() -> u32 {
    const MAJOR: u32 = part(env!("CARGO_PKG_VERSION_MAJOR"));
    const MINOR: u32 = part(env!("CARGO_PKG_VERSION_MINOR"));
    const PATCH: u32 = part(env!("CARGO_PKG_VERSION_PATCH"));
    1_000_000 * MAJOR + 1_000 * MINOR + PATCH
}

/// Version of the loaded library as text, such as "1.2.3". Static: never NULL, never freed.
#[no_mangle]
pub extern "C" fn delotet_version_string() -> *const c_char {
    VERSION.as_ptr().cast()
}
