//! Gives the shared library its SONAME (or install name), which cargo does not, and on Linux and similar systems symbol versions:
//! `delotet_version@@libdelotet.so.0.2`. So the loader recognizes a program that was linked against another ABI, and two versions of the
//! library can coexist in one process.
//!
//! rustc passes the linker a version script of its own with an anonymous version. GNU ld refuses a second, named one beside it, and lld
//! uses only the first. That leaves `--default-symver`, which names the version after the SONAME; of the common linkers only GNU ld has it.
//! So it is tried here, first with rustc's linker, then with GNU ld. If neither works, the library has no symbol versions, and a warning
//! says so.
//!
//! With the feature `tetgen` it compiles `src/tetgen`, which the program links, and neither of the libraries.
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

fn main() {
    for name in ["CARGO_FEATURE_CAPI", "RUSTC_LINKER"] {
        println!("cargo::rerun-if-env-changed={name}");
    }
    println!("cargo::rerun-if-changed=src/build.rs");
    // For the tests, which call the compiler for this target.
    println!("cargo::rustc-env=DELOTET_TARGET={}", var("TARGET"));
    let (major, minor) = (var("CARGO_PKG_VERSION_MAJOR"), var("CARGO_PKG_VERSION_MINOR"));
    let version = if major == "0" { format!("0.{minor}") } else { major };
    // cargo-c sets SONAME and install name itself.
    let own_name = std::env::var_os("CARGO_FEATURE_CAPI").is_none();
    match var("CARGO_CFG_TARGET_OS").as_str() {
        "linux" | "freebsd" | "netbsd" | "openbsd" | "dragonfly" | "android" => {
            if own_name {
                link_arg(&format!("-Wl,-soname,libdelotet.so.{version}"));
            }
            let ways: [&[&str]; 2] = [&["-Wl,--default-symver"], &["-fuse-ld=bfd", "-Wl,--default-symver"]];
            match ways.iter().find(|way| links(way)) {
                Some(way) => way.iter().for_each(|arg| link_arg(arg)),
                None => {
                    println!("cargo::warning=no linker with symbol versions found (GNU ld): libdelotet.so has no symbol versions")
                }
            }
        }
        "macos" if own_name => {
            link_arg(&format!("-Wl,-install_name,@rpath/libdelotet.{version}.dylib"));
            // A program records the compatibility version that it was linked against; dyld refuses a library with a lower one.
            link_arg(&format!("-Wl,-compatibility_version,{version}"));
            link_arg(&format!("-Wl,-current_version,{}", var("CARGO_PKG_VERSION")));
        }
        _ => {}
    }
    #[cfg(feature = "tetgen")]
    compile_tetgen();
}

/// Compiles the C++ code. What it calls in the library is found because the linker gets the program's own libraries first.
#[cfg(feature = "tetgen")]
fn compile_tetgen() {
    println!("cargo::rerun-if-changed=src/tetgen");
    println!("cargo::rerun-if-changed=include/delotet");
    let mut files: Vec<PathBuf> = Vec::new();
    for entry in std::fs::read_dir("src/tetgen").into_iter().flatten().flatten() {
        if entry.path().extension().is_some_and(|extension| extension == "cpp") {
            files.push(entry.path());
        }
    }
    files.sort();
    let mut build = cc::Build::new();
    build.cpp(true).std("c++17").include("include").files(&files).cargo_metadata(false);
    build.compile("delotet_tetgen");
    println!("cargo::rustc-link-search=native={}", var("OUT_DIR"));
    let runtime = if matches!(var("CARGO_CFG_TARGET_OS").as_str(), "macos" | "freebsd" | "openbsd") {
        "c++"
    } else {
        "stdc++"
    };
    println!("cargo::rustc-link-arg-bins=-l{runtime}");
}

fn var(name: &str) -> String {
    std::env::var(name).unwrap_or_default()
}

fn link_arg(arg: &str) {
    println!("cargo::rustc-cdylib-link-arg={arg}");
}

/// Whether a shared library with one function links with these arguments, using the compiler, linker and flags of this build.
fn links(args: &[&str]) -> bool {
    let folder = PathBuf::from(var("OUT_DIR"));
    let source = folder.join("probe.rs");
    if std::fs::write(&source, "#[no_mangle]\npub extern \"C\" fn probe() {}\n").is_err() {
        return false;
    }
    let mut command = Command::new(var("RUSTC"));
    command.args(["--crate-name", "probe", "--crate-type", "cdylib", "--target", &var("TARGET")]);
    command.arg("-o").arg(folder.join("libprobe.so")).arg(Path::new(&source));
    command.args(var("CARGO_ENCODED_RUSTFLAGS").split('\u{1f}').filter(|flag| !flag.is_empty()));
    if let Ok(linker) = std::env::var("RUSTC_LINKER") {
        command.arg(format!("-Clinker={linker}"));
    }
    for arg in args.iter().chain(&["-Wl,-soname,libprobe.so.0"]) {
        command.arg(format!("-Clink-arg={arg}"));
    }
    command.stdout(Stdio::null()).stderr(Stdio::null()).status().is_ok_and(|status| status.success())
}
