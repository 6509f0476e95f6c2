//! Errors for users (stderr) and for programs (JSON).
use super::page::tell;
use super::quality::Quality;
use super::Failure;
use delotet::{Defect, Element, Error, Status, TetMesh, Warning, WarningKind, Warnings};
use serde_json::{json, Value};
use std::io::Write;
use std::path::Path;

/// How many defects are shown on stderr.
const SHOWN: usize = 10;

/// Prints an error: its message, then some of its defects.
pub fn print(error: &Error) {
    let mut err = std::io::stderr().lock();
    let _ = writeln!(err, "error: {}", error.message);
    if let (Status::OutOfMemory, Some(limit)) = (error.status, delotet::ffi::memory::limit()) {
        let _ = writeln!(
            err,
            "  this process is limited to {} MB of address space (ulimit -v)",
            limit / 1_000_000
        );
    }
    for defect in error.defects.iter().take(SHOWN) {
        let _ = writeln!(err, "  {defect}");
    }
    let more = error.defect_count.max(error.defects.len()) - error.defects.len().min(SHOWN);
    if more > 0 {
        let _ = writeln!(err, "  … and {more} more; --report FILE lists all");
    }
}

/// How many warnings of a kind are shown on stderr besides the one that its line names.
const SHOWN_WARNINGS: usize = 5;

/// Prints warnings: a line per kind, followed by some of them if there are several.
pub fn print_warnings(warnings: &Warnings) {
    let mut err = std::io::stderr().lock();
    for kind in WarningKind::ALL {
        let Some(line) = warnings.line(kind) else { continue };
        let _ = writeln!(err, "warning: {line}");
        for warning in warnings.of(kind).skip(1).take(SHOWN_WARNINGS) {
            let _ = writeln!(err, "  {warning}");
        }
        let more = warnings.count(kind).saturating_sub(1 + SHOWN_WARNINGS as u64);
        if more > 0 {
            let _ = writeln!(err, "  … and {more} more; --report FILE lists all");
        }
    }
}

/// The number of warnings of each kind.
pub fn warning_counts(warnings: &Warnings) -> Value {
    let counted = WarningKind::ALL.into_iter().map(|kind| (kind, warnings.count(kind)));
    counted.filter(|x| x.1 > 0).map(|(kind, count)| (kind.name().to_string(), json!(count))).collect()
}

/// The report of a failure.
pub fn of_error(error: &Error) -> Value {
    json!({
        "version": env!("CARGO_PKG_VERSION"),
        "status": format!("{:?}", error.status),
        "status_code": error.status as i32,
        "message": error.message,
        "defect_count": error.defect_count,
        "defects": error.defects.iter().map(defect).collect::<Vec<_>>(),
    })
}

/// The report of a success: no defects; the warnings, the flips of facet merging, the narrow wedges of the input, and the tetrahedra above
/// the ratio that was asked for.
pub fn of_success(mesh: Option<&TetMesh>, quality: &Quality, warnings: &Warnings) -> Value {
    let flips = mesh.map(|m| &m.facet_flips[..]).unwrap_or_default();
    let flip = |f: &delotet::FacetFlip| json!({ "old": f.old, "new": f.new, "facets": f.facets });
    json!({
        "version": env!("CARGO_PKG_VERSION"),
        "status": "Ok",
        "status_code": 0,
        "message": "",
        "defect_count": 0,
        "defects": [],
        "warning_count": warnings.total(),
        "warnings": warnings.list().iter().map(warning).collect::<Vec<_>>(),
        "facet_flips": flips.iter().map(flip).collect::<Vec<_>>(),
        "forced_by": super::quality::forcing_facets(&quality.forced),
        "above_ratio": super::quality::above_ratio(quality.skinny.as_ref()),
    })
}

fn defect(defect: &Defect) -> Value {
    json!({
        "kind": defect.kind.name(),
        "first": element(defect.first),
        "second": defect.second.map(element),
        "point": defect.point,
    })
}

fn warning(warning: &Warning) -> Value {
    json!({
        "kind": warning.kind.name(),
        "first": element(warning.first),
        "second": warning.second.map(element),
        "point": warning.point,
    })
}

fn element(element: Element) -> Value {
    let (kind, index) = match element {
        Element::Point(i) => ("point", i),
        Element::Segment(i) => ("segment", i),
        Element::Facet(i) => ("facet", i),
        Element::Hole(i) => ("hole", i),
        Element::Region(i) => ("region", i),
        Element::Tet(i) => ("tetrahedron", i),
    };
    json!({ "type": kind, "index": index })
}

/// Writes JSON to a file, complete or not at all.
pub fn write(path: &Path, value: &Value) -> Result<(), Error> {
    let text = format!("{value:#}\n");
    delotet::io::write_text(path, &text)
}

/// Writes the report of an outcome if one is requested. If the report cannot be written, a successful run fails; a failed one only prints a
/// line on stderr, since its own error matters more.
pub fn write_if_asked<T>(
    path: Option<&Path>,
    outcome: Result<T, Failure>,
    success: impl FnOnce(&T) -> Value,
) -> Result<T, Failure> {
    let Some(path) = path else { return outcome };
    let value = match &outcome {
        Ok(done) => success(done),
        Err(failure) => of_error(&failure.error),
    };
    match (write(path, &value), &outcome) {
        (Err(error), Ok(_)) => return Err(Failure::usage(error)),
        (Err(error), Err(_)) => tell(format_args!("warning: {error}")),
        (Ok(()), _) => {}
    }
    outcome
}
