//! The files that a command names, looked at before any work is done.
use super::Failure;
use delotet::io::Format;
use delotet::{Error, Status};
use std::path::{Path, PathBuf};

/// Refuses an input that cannot be one by its name.
pub fn check_input(path: &Path) -> Result<(), Failure> {
    if path == Path::new("-") {
        return Err(usage("-: standard input is not read; name a file, whose extension tells the format"));
    }
    Ok(())
}

/// Refuses a file to write whose folder is not there, or that is a folder or standard output.
pub fn check_output(path: &Path) -> Result<(), Failure> {
    if path == Path::new("-") {
        return Err(usage(
            "-: nothing is written to standard output; name a file, whose extension tells the format",
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

/// Refuses outputs of which one would replace another or a file of the input. Asked before anything is written, reports of failure
/// included.
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

/// Refuses a report that cannot be one by its name, or would replace a file that the command reads. Asked before anything that may fail
/// and be reported.
pub fn check_report(report: Option<&Path>, inputs: &[PathBuf]) -> Result<(), Failure> {
    let Some(report) = report else { return Ok(()) };
    check_output(report)?;
    check_distinct(inputs, &[report.to_path_buf()])
}

/// The files that a mesh is written to.
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

/// Whether two names are of one file; devices are never in each other's way.
fn is_same(a: &Path, b: &Path) -> bool {
    let device = |p: &Path| p.metadata().is_ok_and(|m| !m.is_file() && !m.is_dir());
    let full =
        |p: &Path| p.canonicalize().unwrap_or_else(|_| std::path::absolute(p).unwrap_or(p.to_path_buf()));
    full(a) == full(b) && !device(a)
}

fn usage(message: &str) -> Failure {
    Failure::usage(Error::new(Status::InvalidArgument, message.to_string()))
}
