//! The command line program as a process: exit codes, messages, files.
mod program;
use program::{delotet, error_line};
use std::path::{Path, PathBuf};

fn folder(name: &str) -> PathBuf {
    program::folder(&format!("cli-{name}"))
}

const TETRAHEDRON: &str = "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";

#[test]
fn usage_errors_exit_with_2() {
    let dir = folder("usage");
    std::fs::write(dir.join("a.off"), TETRAHEDRON).unwrap();
    for arguments in [
        &["mesh"][..],
        &["mesh", "a.off"],
        &["mesh", "a.off", "-o", "a.xyz"],
        &["mesh", "a.off", "-o", "a.off"],
        &["mesh", "a.off", "-o", "nowhere/a.vtu"],
        &["mesh", "a.off", "-o", "a.vtu", "--threads", "-1"],
        &["mesh", "a.off", "-o", "a.vtu", "--hole", "1,2"],
        &["mesh", "a.off", "-o", "a.vtu", "--region", "1,2,nan,4"],
        &["mesh", "a.off", "-o", "a.vtu", "--merge-facets=10"],
        &["mesh", "a.off", "-o", "a.vtu", "--mode", "fast"],
        &["convert", "a.off", "-o", "a.vtu"],
        &["frobnicate"],
    ] {
        let output = delotet(arguments, &dir);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", error_line(&output));
        assert!(
            error_line(&output).starts_with("error:") || arguments.len() < 2,
            "{arguments:?}: {}",
            error_line(&output)
        );
    }
    assert_eq!(std::fs::read_dir(&dir).unwrap().count(), 1, "nothing may be written");
}

#[test]
fn unusable_input_exits_with_1_and_leaves_only_the_report() {
    let dir = folder("input");
    std::fs::write(dir.join("bad.off"), TETRAHEDRON.replace("0 0 1\n", "0 0 one\n")).unwrap();
    for input in ["bad.off", "absent.off"] {
        let output =
            delotet(&["mesh", input, "-o", "m.ele", "--stats", "s.json", "--report", "r.json"], &dir);
        assert_eq!(output.status.code(), Some(1));
        assert!(error_line(&output).starts_with(&format!("error: {input}: ")), "{}", error_line(&output));
        let mut files: Vec<_> = std::fs::read_dir(&dir).unwrap().map(|f| f.unwrap().file_name()).collect();
        files.sort();
        assert_eq!(files, ["bad.off", "r.json"]);
    }
    assert!(error_line(&delotet(&["info", "bad.off"], &dir))
        .contains("line 6: coordinate z expected, found 'one'"));
}

#[test]
fn conversions_keep_every_point_and_facet() {
    let dir = folder("convert");
    std::fs::write(dir.join("a.off"), TETRAHEDRON).unwrap();
    let mut last = "a.off".to_string();
    for suffix in ["poly", "smesh", "ply", "obj", "stl", "off"] {
        let next = format!("b.{suffix}");
        let output = delotet(&["convert", &last, "-o", &next], &dir);
        assert_eq!(output.status.code(), Some(0), "{next}: {}", error_line(&output));
        last = next;
    }
    let mut lines: Vec<String> =
        std::fs::read_to_string(dir.join("b.off")).unwrap().lines().map(str::to_string).collect();
    assert_eq!(lines.remove(1), "4 4 0");
    // The STL in between orders the points as the triangles meet them.
    assert_eq!(lines[1..5], ["0 0 0", "0 1 0", "1 0 0", "0 0 1"]);
    assert_eq!(lines[5..], ["3 0 1 2", "3 0 2 3", "3 2 1 3", "3 1 0 3"]);
}

#[test]
fn help_and_version_exit_with_0() {
    let dir = folder("help");
    let help = delotet(&["--help"], &dir);
    assert_eq!(help.status.code(), Some(0));
    assert!(String::from_utf8_lossy(&help.stdout).contains("convert"));
    let version = delotet(&["--version"], &dir);
    assert_eq!(
        String::from_utf8_lossy(&version.stdout).trim(),
        concat!("delotet ", env!("CARGO_PKG_VERSION"))
    );
}

/// Everything in the program's help is also in the guide.
#[test]
fn the_guide_names_every_option() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/doc/options.md");
    let guide = std::fs::read_to_string(path).expect("the guide");
    let (mut found, mut missing) = (0, Vec::new());
    for command in ["mesh", "refine", "improve", "check", "info", "convert"] {
        assert!(guide.contains(&format!("`delotet {command} ")), "options.md lacks the command {command}");
        let help = delotet(&[command, "--help"], Path::new("."));
        for line in
            String::from_utf8_lossy(&help.stdout).lines().map(str::trim).filter(|line| line.starts_with('-'))
        {
            let Some(start) = line.find("--") else { continue };
            let option =
                line[start..].split(|c: char| !(c.is_alphanumeric() || c == '-')).next().unwrap_or_default();
            found += 1;
            let named = guide.contains(&format!("`{option}")) || guide.contains(&format!(" {option} "));
            if option != "--help" && !named {
                missing.push(format!("{command} {option}"));
            }
        }
    }
    assert!(found >= 20, "only {found} options found: has the help another form?");
    assert!(missing.is_empty(), "options.md lacks {missing:?}");
}
