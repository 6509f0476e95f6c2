//! For the tests of the command line: the program as a process, in a folder of the test, and two inputs.
// Each test program uses a part of it.
#![allow(dead_code)]
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A call of the program.
pub fn command(arguments: &[&str], folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_delotet"));
    command.args(arguments).current_dir(folder);
    command
}

/// The output and exit code of a call.
pub fn delotet(arguments: &[&str], folder: &Path) -> Output {
    command(arguments, folder).output().expect("the program runs")
}

/// An empty folder of this name; the tests of the other profile, which may run at the same time, have another one.
pub fn folder(name: &str) -> PathBuf {
    let profile = if cfg!(debug_assertions) { "debug" } else { "release" };
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(profile).join(name);
    let _ = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).expect("a folder for the test");
    path
}

/// The text of a file.
pub fn text(path: PathBuf) -> String {
    std::fs::read_to_string(path).expect("the file was written")
}

/// The lines on standard error.
pub fn error_lines(output: &Output) -> Vec<String> {
    String::from_utf8_lossy(&output.stderr).lines().map(str::to_string).collect()
}

/// The first line of it, or nothing.
pub fn error_line(output: &Output) -> String {
    error_lines(output).into_iter().next().unwrap_or_default()
}

/// Two unit cubes side by side with a wall between them: regions 10 and 20, facet markers 1 to 7, 7 the wall.
pub fn two_rooms() -> String {
    let points: String = (0..12).map(|i| format!("{i} {} {} {}\n", i % 3, i / 3 % 2, i / 6)).collect();
    let facets = [
        "4 0 3 9 6",
        "4 2 5 11 8",
        "6 0 1 2 5 4 3",
        "6 6 7 8 11 10 9",
        "6 0 1 2 8 7 6",
        "6 3 4 5 11 10 9",
        "4 1 4 10 7",
    ];
    let facets: String = facets.iter().enumerate().map(|(i, f)| format!("1 0 {}\n{f}\n", i + 1)).collect();
    format!("12 3 0 0\n{points}7 1\n{facets}0\n2\n0 0.5 0.5 0.5 10\n1 1.5 0.5 0.5 20\n")
}
