//! The files that a command names, checked before any work is done.
use super::Failure;
use delotet::io::Format;
use delotet::{Error, Status};
use std::path::{Path, PathBuf};

/// Fails if the name rules it out as an input.
pub fn check_input(path: &Path) -> Result<(), Failure> {
    if path == Path::new("-") {
        return Err(usage(
            "-: standard input is not supported; give a file name, whose extension determines the format",
        ));
    }
    Ok(())
}

/// Fails if the folder of an output does not exist, or if the output is a folder or standard output.
pub fn check_output(path: &Path) -> Result<(), Failure> {
    if path == Path::new("-") {
        return Err(usage(
            "-: standard output is not supported; give a file name, whose extension determines the format",
        ));
    }
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let what = match (path.is_dir(), folder.is_dir()) {
        (true, _) => "is a folder",
        (_, false) => "its folder does not exist",
        _ => return Ok(()),
    };
    Err(Failure::usage(Error::new(Status::File, format!("{}: {what}", path.display()))))
}

/// Fails if an output would replace another output or a file that is read. To be called before anything is written, including reports of
/// failure.
pub fn check_distinct(inputs: &[PathBuf], outputs: &[PathBuf]) -> Result<(), Failure> {
    for (i, output) in outputs.iter().enumerate() {
        if inputs.iter().any(|input| is_same(input, output)) {
            return Err(usage(&format!(
                "{}: the output would replace the input; choose another name",
                output.display()
            )));
        }
        if outputs[..i].iter().any(|other| is_same(other, output)) {
            return Err(usage(&format!("{}: two outputs have this name", output.display())));
        }
    }
    Ok(())
}

/// Fails if the name of a report cannot be one, or if the report would replace a file that the command reads. To be called before anything
/// that may fail and be reported.
pub fn check_report(report: Option<&Path>, inputs: &[PathBuf]) -> Result<(), Failure> {
    let Some(report) = report else { return Ok(()) };
    check_output(report)?;
    check_distinct(inputs, &[report.to_path_buf()])
}

/// All files to which a mesh is written.
pub fn of_mesh(path: &Path, subfaces: bool) -> Vec<PathBuf> {
    match Format::of(path) {
        Ok(Format::Ele) => {
            let suffixes = ["ele", "node", "face", "edge", "neigh", "parents"];
            suffixes.iter().map(|suffix| path.with_extension(suffix)).collect()
        }
        Ok(Format::Vtu) if subfaces => vec![path.to_path_buf(), delotet::io::subfaces_path(path)],
        _ => vec![path.to_path_buf()],
    }
}

/// Whether two names denote the same file; devices never do.
fn is_same(a: &Path, b: &Path) -> bool {
    let device = |p: &Path| p.metadata().is_ok_and(|m| !m.is_file() && !m.is_dir());
    let full =
        |p: &Path| p.canonicalize().unwrap_or_else(|_| std::path::absolute(p).unwrap_or(p.to_path_buf()));
    full(a) == full(b) && !device(a)
}

fn usage(message: &str) -> Failure {
    Failure::usage(Error::new(Status::InvalidArgument, message.to_string()))
}
