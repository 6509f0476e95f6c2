//! The program with TetGen's switches, as the command `tetgen` and by a link of that name. `capi-tests/tetgen/test_program.cmake` has the
//! tests of what it does; these are of how it is called.
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const SIMPLEX: &str = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

/// A new folder with a file `simplex.off`.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("simplex.off"), SIMPLEX).unwrap();
    folder
}

fn run(program: impl AsRef<Path>, folder: &Path, words: &[&str]) -> Output {
    Command::new(program.as_ref()).args(words).current_dir(folder).output().unwrap()
}

fn program() -> &'static str {
    env!("CARGO_BIN_EXE_delotet")
}

#[test]
fn the_command_writes_tetgens_files() {
    let folder = folder("tetgen_command");
    let output = run(program(), &folder, &["tetgen", "-pA", "simplex.off"]);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    assert!(String::from_utf8(output.stdout).unwrap().contains("Mesh tetrahedra: 1\n"));
    let elements = fs::read_to_string(folder.join("simplex.1.ele")).unwrap();
    assert!(elements.starts_with("1  4  1\n"), "{elements}");
    for ending in ["node", "face", "edge"] {
        assert!(folder.join(format!("simplex.1.{ending}")).exists());
    }
}

#[test]
fn a_link_named_tetgen_does_the_same() {
    let folder = folder("tetgen_link");
    for name in ["tetgen", "tetgen1.5"] {
        let link = folder.join(name);
        std::os::unix::fs::symlink(program(), &link).unwrap();
        let output = run(&link, &folder, &["-pQ", "simplex.off"]);
        assert_eq!(output.status.code(), Some(0), "{output:?}");
        assert!(output.stdout.is_empty() && output.stderr.is_empty());
        fs::remove_file(folder.join("simplex.1.ele")).unwrap();
    }
}

#[test]
fn exit_codes_are_those_of_what_failed() {
    let folder = folder("tetgen_codes");
    let code = |words: &[&str]| run(program(), &folder, words).status.code();
    assert_eq!(code(&["tetgen", "-h"]), Some(0));
    assert_eq!(code(&["tetgen"]), Some(1));
    assert_eq!(code(&["tetgen", "-pRQ", "simplex.off"]), Some(1));
    assert_eq!(code(&["tetgen", "-pQ", "nothing.poly"]), Some(10));
}
