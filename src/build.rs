//! Sets the SONAME (or install name) of the shared library; cargo itself sets none. Nothing else happens here.
fn main() {
    println!("cargo::rerun-if-changed=src/build.rs");
    println!("cargo::rerun-if-env-changed=CARGO_FEATURE_CAPI");
    if std::env::var_os("CARGO_FEATURE_CAPI").is_some() {
        return;
    }
    let var = |name: &str| std::env::var(name).unwrap_or_default();
    let (major, minor) = (var("CARGO_PKG_VERSION_MAJOR"), var("CARGO_PKG_VERSION_MINOR"));
    let version = if major == "0" { format!("0.{minor}") } else { major };
    match var("CARGO_CFG_TARGET_OS").as_str() {
        "linux" | "freebsd" | "netbsd" | "openbsd" | "dragonfly" | "android" => {
            println!("cargo::rustc-cdylib-link-arg=-Wl,-soname,libdelotet.so.{version}");
        }
        "macos" => {
            println!("cargo::rustc-cdylib-link-arg=-Wl,-install_name,@rpath/libdelotet.{version}.dylib");
        }
        _ => {}
    }
}
