//! Rules for README and guide that need no build; `capi-tests/readme.py` runs their code blocks.
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The first page should be readable in one go.
const LONGEST_README: usize = 200;

fn read(path: impl AsRef<Path>) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The pages of the guide, by name, sorted.
fn pages() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/doc");
    let mut found: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    found.sort();
    found
}

#[test]
fn readme_is_short() {
    let lines = read("README.md").lines().count();
    assert!(
        lines <= LONGEST_README,
        "README.md has {lines} lines; what is more than {LONGEST_README} belongs in src/doc"
    );
}

/// Every page is a module of the documentation, and the README leads to it.
#[test]
fn every_page_is_shown() {
    let (modules, readme) = (read("src/doc.rs"), read("README.md"));
    for page in pages() {
        let name = page.file_name().unwrap().to_str().unwrap();
        let stem = name.strip_suffix(".md").expect("pages are Markdown");
        assert!(modules.contains(&format!("{stem} \"doc/{name}\"")), "src/doc.rs does not declare {name}");
        assert!(
            modules.contains(&format!("[{stem}]: crate::doc::{stem}")),
            "src/doc.rs defines no link to {name}"
        );
        assert!(readme.contains(&format!("(src/doc/{name})")), "README.md does not lead to {name}");
    }
}

/// The guide lists what the library contains, with its licences, all of which leave the program that links it free to choose its own.
#[test]
fn licences_of_all_that_is_linked_are_listed() {
    const PERMISSIVE: [&str; 3] = ["MIT", "Apache-2.0", "Zlib"];
    let tree = Command::new(env!("CARGO"))
        .args(["tree", "--locked", "--edges=normal", "--no-default-features", "--features=io"])
        .args(["--prefix=none", "--format={p}: {l}", "--manifest-path"])
        .arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("Cargo.toml"))
        .output()
        .unwrap();
    assert!(tree.status.success(), "{}", String::from_utf8_lossy(&tree.stderr));
    let page = read("src/doc/install.md");
    let listed = page.split("## Licences").nth(1).expect("the section on licences");
    let mut crates = 0;
    for line in String::from_utf8(tree.stdout).unwrap().lines() {
        let (package, licences) = line.split_once(": ").unwrap();
        let name = package.split(' ').next().unwrap();
        if name == env!("CARGO_PKG_NAME") {
            continue;
        }
        crates += 1;
        let row = listed.lines().find(|row| row.starts_with('|') && row.contains(&format!("`{name}`")));
        let row = row.unwrap_or_else(|| panic!("{name} ({licences}) is not listed"));
        for licence in licences.split(" OR ") {
            let short = licence.trim_end_matches("-2.0");
            assert!(row.contains(short), "{name}: {licence} is not in {row}");
            assert!(PERMISSIVE.contains(&licence), "{name}: {licence}");
        }
    }
    assert!(crates >= 6, "{crates} crates: has the form of the list changed?");
}

/// The versions requested from CMake and the fetched tag are those of this release.
#[test]
fn versions_are_the_crates() {
    let version = env!("CARGO_PKG_VERSION");
    let minor = version.rsplit_once('.').unwrap().0;
    let mut found = 0;
    let files =
        ["README.md", "examples-c/CMakeLists.txt", "capi-tests/peers/CMakeLists.txt"].map(PathBuf::from);
    for file in files.into_iter().chain(pages()) {
        let text = read(&file);
        for (mark, end, right) in [("find_package(delotet ", ' ', minor), ("GIT_TAG v", ' ', version)] {
            for asked in text.split(mark).skip(1).map(|rest| rest.split(end).next().unwrap()) {
                if asked.starts_with(|c: char| c.is_ascii_digit()) {
                    found += 1;
                    assert_eq!(asked, right, "{}: {mark}{asked}", file.display());
                }
            }
        }
    }
    assert!(found >= 4, "only {found} versions found: has their form changed?");
}

/// The README's test command is what continuous integration runs.
#[test]
fn continuous_integration_runs_the_readmes_command() {
    let script = "capi-tests/run-tests.sh";
    assert!(read("README.md").contains(&format!("\nbash {script}\n")));
    let run = read(".ci/run");
    assert!(
        run.lines().any(|line| line.starts_with("exec bash ") && line.contains(script)),
        ".ci/run:\n{run}"
    );
}
