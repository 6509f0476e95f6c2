//! Enforces the module graph in `src/lib.rs` and the rules that keep the code readable and safe to embed.
//!
//! It scans lines and does not parse: it drops comments and strings, knows `crate::` and `super::` paths, and skips tests.
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Which modules a top-level module may import. Tests may import anything.
const ALLOWED: &[(&str, &[&str])] = &[
    // Leaves.
    ("doc", &[]),
    ("error", &["options", "fallible"]),
    ("fallible", &[]),
    ("elementary", &[]),
    ("panics", &["error"]),
    ("progress", &[]),
    ("control", &["error", "progress"]),
    ("options", &["error", "control"]),
    ("warning", &["error", "control"]),
    ("threads", &[]),
    ("workers", &["error", "panics", "threads"]),
    ("vector", &[]),
    ("output", &["progress", "error", "warning"]),
    ("predicates", &["error"]),
    ("plc", &["predicates", "vector", "output", "error", "options", "control", "progress", "warning"]),
    // The engine, from the bottom up.
    ("kernel", &["error"]),
    ("ops", &["kernel", "predicates", "vector", "error"]),
    ("delaunay", &["kernel", "predicates", "error", "progress", "options"]),
    ("segments", &["delaunay", "kernel", "predicates", "plc", "vector", "error", "progress", "options"]),
    (
        "facets",
        &["segments", "delaunay", "kernel", "predicates", "plc", "vector", "error", "progress", "options"],
    ),
    (
        "domain",
        &["facets", "segments", "kernel", "predicates", "plc", "output", "error", "progress", "options"],
    ),
    (
        "rounding",
        &[
            "ops",
            "domain",
            "segments",
            "delaunay",
            "kernel",
            "predicates",
            "vector",
            "error",
            "progress",
            "options",
        ],
    ),
    (
        "preserve",
        &[
            "ops",
            "domain",
            "facets",
            "segments",
            "delaunay",
            "kernel",
            "predicates",
            "vector",
            "plc",
            "output",
            "error",
            "progress",
            "options",
        ],
    ),
    ("size", &["kernel", "predicates", "vector", "error", "options"]),
    ("blocks", &["preserve", "kernel", "predicates", "vector", "error", "progress"]),
    (
        "optimise",
        &[
            "blocks",
            "preserve",
            "ops",
            "size",
            "kernel",
            "predicates",
            "vector",
            "output",
            "error",
            "progress",
        ],
    ),
    (
        "fill",
        &[
            "blocks",
            "preserve",
            "ops",
            "size",
            "kernel",
            "predicates",
            "vector",
            "output",
            "error",
            "options",
            "progress",
        ],
    ),
    (
        "refine",
        &["fill", "preserve", "segments", "ops", "size", "kernel", "predicates", "vector", "output", "error"],
    ),
    (
        "plan",
        &[
            "blocks",
            "fill",
            "refine",
            "optimise",
            "size",
            "preserve",
            "rounding",
            "domain",
            "facets",
            "segments",
            "delaunay",
            "kernel",
            "predicates",
            "plc",
            "output",
            "check",
            "error",
            "control",
            "progress",
            "options",
            "warning",
        ],
    ),
    // What looks at results; it never touches the engine.
    ("check", &["output", "plc", "predicates", "error", "options"]),
    ("query", &["output", "plc", "predicates", "vector", "error", "options"]),
    ("io", &["query", "plc", "vector", "output", "error", "options", "control", "warning"]),
    (
        "ffi",
        &[
            "plan", "plc", "options", "output", "error", "control", "fallible", "progress", "check", "query",
            "io", "warning",
        ],
    ),
    ("internals", &["delaunay", "kernel", "predicates"]),
    // The program sees the library from outside, as `delotet::`.
    ("cli", &[]),
    ("main", &["cli"]),
];

/// Modules that may be imported anywhere, and may refer to each other.
const LEAVES: &[&str] = &[
    "control",
    "elementary",
    "error",
    "fallible",
    "options",
    "panics",
    "progress",
    "threads",
    "warning",
    "workers",
];

/// Leaves that need not be listed: general tools.
const OPEN: &[&str] = &["control", "elementary", "fallible", "panics", "threads", "workers"];

/// Files outside of `ffi` that may use `unsafe`, each with the reason.
const UNSAFE_FILES: &[(&str, &str)] = &[
    ("cli/tetgen.rs", "the program calls C++, which calls the C API"),
    ("kernel/slots.rs", "workers share the arrays of tetrahedra, each on its own slots"),
    ("threads.rs", "the system's threads, since the standard library's abort if memory runs out"),
];

const LONGEST_FILE: usize = 900;

/// Words that the library must not contain: it never prints, exits or panics.
const FORBIDDEN: &[&str] = &[
    "println!",
    "eprintln!",
    "print!",
    "eprint!",
    "dbg!",
    "process::exit",
    "panic!",
    "todo!",
    "unimplemented!",
];

/// Conversions that abort the process if memory runs out. `.clippy.toml` cannot list them apart from those that allocate nothing.
const ABORTING: &[&str] = &[
    "Arc::from",
    "Box::from",
    "CString::from",
    "HashMap::from",
    "HashSet::from",
    "OsString::from",
    "PathBuf::from",
    "Rc::from",
    "String::from",
    "Vec::from",
    "VecDeque::from",
];

/// Name at the crate's root -> module that defines it.
type Exports = BTreeMap<String, String>;

struct Scan<'a> {
    /// Path below `src`, with `/`.
    path: &'a str,
    exports: &'a Exports,
    faults: Vec<String>,
}

/// A line without comments, strings and character literals.
fn code(line: &str) -> String {
    let mut out = String::new();
    let mut chars = line.replace("'\"'", "' '").chars().collect::<Vec<_>>().into_iter().peekable();
    let mut in_string = false;
    while let Some(c) = chars.next() {
        match c {
            '\\' if in_string => drop(chars.next()),
            '"' => in_string = !in_string,
            '/' if !in_string && chars.peek() == Some(&'/') => break,
            _ if in_string => {}
            _ => out.push(c),
        }
    }
    out
}

/// Whether `text` contains `word` on its own, not as part of a longer identifier.
fn has_word(text: &str, word: &str) -> bool {
    let part = |c: char| c.is_alphanumeric() || c == '_';
    text.match_indices(word).any(|(i, _)| {
        !text[..i].chars().next_back().is_some_and(part)
            && !text[i + word.len()..].chars().next().is_some_and(part)
    })
}

fn identifier(text: &str) -> &str {
    let end = text.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(text.len());
    &text[..end]
}

/// The names right after `prefix` in `text`: one, or those of a group in braces.
fn names_after(text: &str, prefix: &str) -> Vec<String> {
    let mut names = Vec::new();
    for (i, _) in text.match_indices(prefix) {
        if text[..i].ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == '$' || c == ':') {
            continue;
        }
        let rest = &text[i + prefix.len()..];
        if !rest.starts_with('{') {
            names.push(identifier(rest).to_string());
            continue;
        }
        let mut depth = 0;
        let mut fresh = false;
        for (j, c) in rest.char_indices() {
            match c {
                '{' => (depth, fresh) = (depth + 1, depth == 0),
                '}' => depth -= 1,
                ',' => fresh = depth == 1,
                c if c.is_whitespace() => {}
                _ if fresh => {
                    names.push(identifier(&rest[j..]).to_string());
                    fresh = false;
                }
                _ => {}
            }
            if depth == 0 {
                break;
            }
        }
    }
    names
}

/// Top-level module of a file: `kernel/star.rs` and `kernel/mod.rs` and `kernel.rs` belong to `kernel`.
fn module_of(path: &str) -> &str {
    path.split(['/', '.']).next().unwrap_or(path)
}

fn is_test_file(path: &str) -> bool {
    path.ends_with("tests.rs") || path.contains("/tests/")
}

impl Scan<'_> {
    fn fault(&mut self, line: usize, what: impl std::fmt::Display) {
        self.faults.push(format!("src/{}:{}: {what}", self.path, line + 1));
    }

    fn file(&mut self, text: &str) {
        let count = text.lines().count();
        if count > LONGEST_FILE {
            self.fault(LONGEST_FILE, format!("{count} lines, more than {LONGEST_FILE}"));
        }
        if is_test_file(self.path) || self.path == "build.rs" || self.path == "lib.rs" {
            return;
        }
        let lines: Vec<String> = text.lines().map(code).collect();
        // Inline modules around the current line, by indentation; whether a test module is among them.
        let mut inline: Vec<(usize, bool)> = Vec::new();
        for (i, line) in lines.iter().enumerate() {
            let trimmed = line.trim_start();
            let indent = line.len() - trimmed.len();
            if trimmed.is_empty() {
                continue;
            }
            inline.retain(|m| m.0 < indent);
            let declares = trimmed.trim_start_matches("pub").trim_start_matches("(crate)").trim_start();
            if declares.starts_with("mod ") && trimmed.trim_end().ends_with('{') {
                let test = i > 0 && lines[i - 1].contains("cfg(test)");
                inline.push((indent, test));
            }
            if inline.iter().any(|m| m.1) {
                continue;
            }
            self.words(i, line);
            // A group of imports may go over several lines: join up to its end.
            let mut whole = line.clone();
            if line.contains("::{")
                && line.matches('{').count() > line.matches('}').count()
                && line.contains("use ")
            {
                for more in &lines[i + 1..] {
                    whole.push_str(more);
                    if more.contains(';') {
                        break;
                    }
                }
            }
            self.imports(i, &whole, inline.len());
        }
    }

    fn words(&mut self, i: usize, line: &str) {
        let module = module_of(self.path).to_string();
        if line.contains("robust::") && module != "predicates" {
            self.fault(i, "robust is called by predicates only");
        }
        let listed = UNSAFE_FILES.iter().any(|f| f.0 == self.path);
        if has_word(line, "unsafe") && module != "ffi" && !listed {
            self.fault(i, "unsafe outside ffi");
        }
        if module == "kernel" && has_word(line, "f64") {
            self.fault(i, "the topology layer knows no coordinates");
        }
        if module != "main" && module != "cli" {
            for word in FORBIDDEN.iter().filter(|w| has_word(line, w)) {
                self.fault(i, format!("{word} in the library"));
            }
            for word in ABORTING.iter().filter(|w| has_word(line, w)) {
                self.fault(i, format!("{word} allocates, and aborts if it cannot"));
            }
        }
    }

    fn imports(&mut self, i: usize, line: &str, inline: usize) {
        let own = module_of(self.path).to_string();
        let mut names = names_after(line, "crate::");
        // `super::` as often as the file lies deep leads to the crate's root.
        let depth = self.path.matches('/').count() + usize::from(!self.path.ends_with("/mod.rs")) + inline;
        names.extend(names_after(line, &"super::".repeat(depth)).into_iter().filter(|n| n != "super"));
        let Some(allowed) = ALLOWED.iter().find(|a| a.0 == own) else {
            return self.fault(i, format!("module {own} is not in the table of allowed imports"));
        };
        for name in names {
            let module = match self.exports.get(&name) {
                Some(module) => module.clone(),
                None => name.clone(),
            };
            // Items of lib.rs itself belong to everyone; what a module may import, it may import by either name.
            let fine = module.is_empty()
                || module == own
                || OPEN.contains(&module.as_str())
                || allowed.1.contains(&module.as_str());
            let root = matches!(own.as_str(), "main" | "cli") && module == "cli";
            if !fine && !root {
                self.fault(i, format!("{own} imports {module} (as {name})"));
            }
        }
    }
}

/// What `lib.rs` re-exports (`pub use module::{names};`), and its own constants (module "").
fn exports(lib: &str) -> Exports {
    let mut out = Exports::new();
    let text: String = lib.lines().map(|l| code(l) + " ").collect();
    for item in text.split(';') {
        if let Some(i) = item.find("pub use ") {
            let path = &item[i + 8..];
            let module = identifier(path).to_string();
            for name in names_after(&format!(" {path}"), &format!("{module}::")) {
                // A function named as its module is found under either name.
                out.insert(name, module.clone());
            }
        } else if let Some(i) = item.find("pub const ") {
            out.insert(identifier(&item[i + 10..]).to_string(), String::new());
        }
    }
    out
}

fn sources(folder: &Path, out: &mut Vec<PathBuf>) {
    let mut entries: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            sources(&path, out);
        } else if path.extension().is_some_and(|e| e == "rs") {
            out.push(path);
        }
    }
}

fn scan(path: &str, text: &str, exports: &Exports) -> Vec<String> {
    let mut scan = Scan { path, exports, faults: Vec::new() };
    scan.file(text);
    scan.faults
}

#[test]
fn the_code_keeps_to_the_module_graph() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let exports = exports(&fs::read_to_string(root.join("lib.rs")).unwrap());
    assert_eq!(exports.get("TetMesh").map(String::as_str), Some("output"));
    assert_eq!(exports.get("INVALID").map(String::as_str), Some(""));
    let mut files = Vec::new();
    sources(&root, &mut files);
    assert!(files.len() > 10);
    let mut faults = Vec::new();
    for file in files {
        let path = file.strip_prefix(&root).unwrap().to_string_lossy().replace('\\', "/");
        faults.extend(scan(&path, &fs::read_to_string(&file).unwrap(), &exports));
    }
    assert!(faults.is_empty(), "\n{}\n", faults.join("\n"));
}

#[test]
fn the_table_has_no_cycle() {
    // Leaves may name each other in signatures; all others must be in an order in which each imports earlier ones only.
    let mut done: Vec<&str> = LEAVES.to_vec();
    type Row = &'static (&'static str, &'static [&'static str]);
    let mut left: Vec<Row> = ALLOWED.iter().filter(|m| !LEAVES.contains(&m.0)).collect();
    while !left.is_empty() {
        let before = left.len();
        let (ready, rest): (Vec<Row>, Vec<Row>) =
            left.into_iter().partition(|m| m.1.iter().all(|name| done.contains(name)));
        done.extend(ready.iter().map(|m| m.0));
        left = rest;
        assert!(left.len() < before, "a cycle among {:?}", left.iter().map(|m| m.0).collect::<Vec<_>>());
    }
    for (_, imports) in ALLOWED {
        assert!(imports.iter().all(|name| done.contains(name)));
    }
}

/// The scanner must be able to fail: each bad line is found, each good one is not.
#[test]
fn the_scanner_finds_what_it_should() {
    let exports = exports("pub use error::{Error, Status};\npub use output::{\n    Region, TetMesh,\n};\npub const INVALID: u32 = 0;\n");
    let count = |path: &str, text: &str| scan(path, text, &exports).len();
    let bad = [
        ("kernel/star.rs", "use crate::predicates::Sign;"),
        ("kernel/mod.rs", "use super::predicates::Sign;"),
        ("kernel/star.rs", "use super::super::predicates::Sign;"),
        ("kernel/star.rs", "let x: f64 = 0.0;"),
        ("check/mod.rs", "use crate::{error::Error, kernel::Mesh};"),
        ("check/mod.rs", "use crate::{\n    error::Error,\n    delaunay::{a, b},\n};"),
        ("check/mod.rs", "fn f() { crate::facets::run() }"),
        ("predicates/mod.rs", "use crate::TetMesh;"),
        ("cli/mod.rs", "use crate::io::read;"),
        ("unknown/mod.rs", "fn f() {}"),
        ("plc/mod.rs", "robust::orient2d(a, b, c)"),
        ("plc/mod.rs", "let x = unsafe { *p };"),
        ("plc/mod.rs", "println!(\"hello\");"),
        ("plc/mod.rs", "std::process::exit(1);"),
        ("plc/mod.rs", "let name = String::from(\"x\");"),
        ("plc/mod.rs", concat!("to", "do!()")),
        ("plc/mod.rs", "mod inner {\n    use super::super::io::read;\n}"),
    ];
    for (path, text) in bad {
        assert_eq!(count(path, text), 1, "{path}: {text}: {:?}", scan(path, text, &exports));
    }
    let good = [
        ("kernel/star.rs", "use crate::error::Error;\nuse super::Mesh;\nuse crate::INVALID;"),
        ("check/mod.rs", "use crate::{Error, TetMesh, INVALID};"),
        ("check/mod.rs", "// use crate::kernel::Mesh;\n//! unsafe println!"),
        ("check/mod.rs", "let s = \"crate::mesh unsafe panic!\";"),
        ("check/mod.rs", "#[cfg(test)]\nmod t {\n    use crate::kernel::Mesh;\n    fn f() { panic!() }\n}"),
        ("check/tests.rs", "use crate::kernel::Mesh;"),
        ("plc/mod.rs", "#![deny(unsafe_code)]"),
        ("ffi/mod.rs", "let x = unsafe { *p };"),
        ("main.rs", "mod cli;\nfn main() { println!(\"x\") }"),
        ("plc/mod.rs", "mod inner {\n    use super::predicates;\n}"),
    ];
    for (path, text) in good {
        assert_eq!(scan(path, text, &exports), Vec::<String>::new(), "{path}");
    }
    assert_eq!(count("plc/mod.rs", &"\n".repeat(901)), 1);
}
