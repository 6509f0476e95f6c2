//! The committed C header is the one that cbindgen generates from `src/ffi`, and `src/ffi` follows its conventions. Within a minor version
//! nothing in the interface is removed or changed: `capi-tests/abi/<major>.<minor>.txt` lists it. `UPDATE_HEADER=1 cargo test --test
//! header` rewrites the header and adds to that list, but removes nothing from it.
use std::path::{Path, PathBuf};

/// In the order in which the header explains them.
const SOURCES: [&str; 20] = [
    "version", "status", "view", "error", "options", "limits", "plc", "plc_view", "sizes", "mesh", "weights",
    "warning", "run", "given", "query", "quality", "skinny", "voronoi", "file", "write",
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

/// The interface of a header, one item per line: functions, struct fields with their positions, numbers, types.
fn interface(header: &str) -> Vec<String> {
    let mut text = String::new();
    let mut rest = header;
    while let Some((before, comment)) = rest.split_once("/*") {
        text += before;
        rest = comment.split_once("*/").map_or("", |parts| parts.1);
    }
    text += rest;
    let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let mut lines = Vec::new();
    for line in text.lines().filter_map(|line| line.strip_prefix("#define DELOTET_")) {
        // Macros for compilers and the version are not part of it.
        let part = line.split_once(' ').filter(|part| part.1.starts_with(|c: char| c.is_ascii_digit()));
        if let Some((name, value)) = part.filter(|part| !part.0.starts_with("VERSION")) {
            lines.push(format!("DELOTET_{name} = {value}"));
        }
    }
    let code: String =
        text.lines().filter(|line| !line.starts_with('#')).map(|line| line.to_string() + "\n").collect();
    for part in code.split("DELOTET_API").skip(1) {
        lines.push(words(part.split(';').next().unwrap_or_default()).replace("DELOTET_MUST_USE ", ""));
    }
    for part in code.split("typedef ").skip(1) {
        let (head, body) = part.split_once('{').unwrap_or((part, ""));
        let kind = head.split_whitespace().next().unwrap_or_default();
        if head.contains(';') {
            lines.push(format!("typedef {}", words(head.split(';').next().unwrap_or_default())));
            continue;
        }
        let name = head.split_whitespace().nth(1).unwrap_or_default();
        let body = body.split('}').next().unwrap_or_default();
        match kind {
            "enum" => lines.extend(body.split(',').map(words).filter(|line| !line.is_empty())),
            _ => lines.extend(
                body.split(';')
                    .map(words)
                    .filter(|line| !line.is_empty())
                    .enumerate()
                    .map(|(place, field)| format!("{name} field {place}: {field}")),
            ),
        }
    }
    lines.sort();
    lines.dedup();
    lines
}

/// The entries of a list that are missing from another.
fn missing(list: &[String], from: &[String]) -> Vec<String> {
    list.iter().filter(|line| !from.contains(line)).cloned().collect()
}

#[test]
fn nothing_of_the_interface_is_lost_within_a_minor_version() {
    let version = concat!(env!("CARGO_PKG_VERSION_MAJOR"), ".", env!("CARGO_PKG_VERSION_MINOR"), ".txt");
    let path = root().join("capi-tests/abi").join(version);
    let now = interface(&generated());
    let update = std::env::var_os("UPDATE_HEADER").is_some();
    let listed: Vec<String> = match path.exists() || !update {
        true => read(&path).lines().map(String::from).collect(),
        false => Vec::new(), // The first of a new minor version.
    };
    let lost = missing(&listed, &now);
    let advice = "if that version is not released yet, delete these lines there";
    assert!(lost.is_empty(), "{version} promises what the header has not ({advice}):\n{}", lost.join("\n"));
    if update {
        return std::fs::write(&path, now.join("\n") + "\n").expect("write the list");
    }
    let fresh = missing(&now, &listed);
    assert!(
        fresh.is_empty(),
        "not in {version}, run UPDATE_HEADER=1 cargo test --test header:\n{}",
        fresh.join("\n")
    );
    assert!(now.len() > 300, "only {} lines", now.len());
}

/// The comparison must be able to fail: each kind of change is reported, no kind of addition is.
#[test]
fn changes_of_the_interface_are_seen() {
    let header = "#define DELOTET_MODE_A 0\n/** Text; DELOTET_API { */\ntypedef enum E {\n    /**\n     * One.\n     */\n    E_ONE = 1,\n} E;\n\
        typedef struct S {\n    uint32_t a;\n    double b[3];\n} S;\ntypedef uint32_t T;\n\
        DELOTET_API DELOTET_MUST_USE E f(const S *s,\n    T t);\n";
    let before = interface(header);
    let expected = [
        "DELOTET_MODE_A = 0",
        "E f(const S *s, T t)",
        "E_ONE = 1",
        "S field 0: uint32_t a",
        "S field 1: double b[3]",
    ];
    assert_eq!(before[..5].iter().map(String::as_str).collect::<Vec<_>>(), expected);
    let lost = |from: &str, to: &str| {
        assert!(header.contains(from));
        missing(&before, &interface(&header.replacen(from, to, 1))).len()
    };
    for (from, to) in [
        ("_A 0", "_A 1"),
        ("E_ONE = 1", "E_ONE = 2"),
        ("uint32_t a", "uint64_t a"),
        ("uint32_t a;", "uint32_t c;\n    uint32_t a;"),
        ("const S *s", "S *s"),
        ("f(", "g("),
        ("typedef uint32_t T", "typedef uint64_t T"),
    ] {
        assert!(lost(from, to) > 0, "{from} to {to}");
    }
    for (from, to) in [
        ("double b[3];", "double b[3];\n    double c;"),
        ("E_ONE = 1,", "E_ONE = 1,\n    E_TWO = 2,"),
        ("typedef uint32_t T;", "typedef uint32_t T;\nDELOTET_API void g(void);"),
        ("Text", "Other text"),
    ] {
        assert_eq!(lost(from, to), 0, "{from} to {to}");
    }
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
    // These read constants, do simple arithmetic or set a flag, so nothing in them can fail.
    let constant = [
        "delotet_version",
        "delotet_version_string",
        "delotet_phase_overall",
        "delotet_cancel_token_cancel",
        "delotet_quality_bin_edges",
        "delotet_quality_bin_name",
    ];
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
