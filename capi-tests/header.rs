//! The committed C header is the one that cbindgen makes of `src/ffi`, and `src/ffi` keeps its conventions.
//! `UPDATE_HEADER=1 cargo test --test header` rewrites the header.
use std::path::{Path, PathBuf};

/// In the order in which the header explains them.
const SOURCES: [&str; 12] = [
    "version", "status", "view", "error", "options", "plc", "plc_view", "mesh", "warning", "run", "query",
    "file",
];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn ffi(name: &str) -> PathBuf {
    root().join("src/ffi").join(name).with_extension("rs")
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The comment at the head of the header, and the macros behind its includes.
fn hand_written() -> (String, String) {
    let part = |text: &str| text.parse::<u32>().expect("a number");
    let (major, minor, patch) = (
        part(env!("CARGO_PKG_VERSION_MAJOR")),
        part(env!("CARGO_PKG_VERSION_MINOR")),
        part(env!("CARGO_PKG_VERSION_PATCH")),
    );
    let version = 1_000_000 * major + 1_000 * minor + patch;
    let text = read(&root().join("include/delotet.h.in"))
        .replace("@MAJOR@", &major.to_string())
        .replace("@MINOR@", &minor.to_string())
        .replace("@PATCH@", &patch.to_string())
        .replace("@STRING@", env!("CARGO_PKG_VERSION"))
        .replace("@VERSION@", &version.to_string());
    let (comment, macros) = text.split_once("*/\n").expect("a comment");
    (format!("{comment}*/"), macros.trim_end().to_string())
}

fn generated() -> String {
    let config = cbindgen::Config::from_file(root().join("include/cbindgen.toml")).expect("cbindgen.toml");
    let (comment, macros) = hand_written();
    let mut builder =
        cbindgen::Builder::new().with_config(config).with_header(comment).with_after_include(macros);
    for source in SOURCES {
        builder = builder.with_src(ffi(source));
    }
    let mut text = Vec::new();
    builder.generate().expect("bindings").write(&mut text);
    String::from_utf8(text).expect("UTF-8")
}

#[test]
fn header_is_current() {
    let path = root().join("include/delotet/delotet.h");
    let expected = generated();
    if std::env::var_os("UPDATE_HEADER").is_some() {
        std::fs::write(&path, expected).expect("write the header");
        return;
    }
    assert!(read(&path) == expected, "the header is stale: run UPDATE_HEADER=1 cargo test --test header");
}

/// The exported functions of a source file: name and body.
fn exports(source: &str) -> Vec<(String, String)> {
    let mut list = Vec::new();
    for part in source.split("#[no_mangle]").skip(1) {
        let name = part.split("fn ").nth(1).and_then(|rest| rest.split('(').next()).expect("a name");
        let body = part.split_once("{\n").and_then(|(_, rest)| rest.split_once("\n}\n")).expect("a body").0;
        list.push((name.to_string(), body.to_string()));
    }
    list
}

#[test]
fn exported_functions_are_short_and_guarded() {
    // These read constants: nothing in them can fail.
    let constant = ["delotet_version", "delotet_version_string"];
    let guards = ["guard(", "change(", "setting(", "settings(", "read(", "make(", "free(", "name_in("];
    let mut count = 0;
    for source in SOURCES {
        for (name, body) in exports(&read(&ffi(source))) {
            count += 1;
            assert!(name.starts_with("delotet_"), "{name}");
            assert!(body.lines().count() <= 15, "{name} has more than 15 lines");
            let guarded = guards.iter().any(|guard| body.contains(guard));
            assert!(guarded || constant.contains(&name.as_str()), "{name} has no guard");
        }
    }
    assert!(count > 50, "only {count} exported functions were found");
}

#[test]
fn every_exported_function_has_a_test() {
    let mut missing = Vec::new();
    for source in SOURCES {
        for (name, _) in exports(&read(&ffi(source))) {
            let short = name.strip_prefix("delotet_").expect("prefix").to_string();
            if !root().join(format!("capi-tests/c/test_{short}.c")).exists() {
                missing.push(name);
            }
        }
    }
    assert!(missing.is_empty(), "no file capi-tests/c/test_<function>.c for {missing:?}");
}

#[test]
fn all_sources_with_exports_are_listed() {
    for entry in std::fs::read_dir(root().join("src/ffi")).expect("src/ffi") {
        let path = entry.expect("entry").path();
        let stem = path.file_stem().and_then(|stem| stem.to_str()).expect("a name").to_string();
        if read(&path).contains("\n#[no_mangle]") {
            assert!(SOURCES.contains(&stem.as_str()), "{stem}.rs is not in SOURCES");
        }
    }
}
