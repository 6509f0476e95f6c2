//! `delotet info`.
use super::args::InfoArgs;
use super::observer::Console;
use super::{report, summary, Failure};
use delotet::{Options, Warnings};

/// Reads a file, says what is in it, and validates it.
pub fn run(args: &InfoArgs) -> Result<(), Failure> {
    let outcome = info(args);
    report::write_if_asked(args.report.as_deref(), || match &outcome {
        Ok(warnings) => report::of_success(None, warnings),
        Err(failure) => report::of_error(&failure.error),
    });
    outcome.map(|_| ())
}

fn info(args: &InfoArgs) -> Result<Warnings, Failure> {
    let plc = delotet::io::read(&args.input)?;
    summary::print_plc(&args.input, &plc);
    let mut console = Console::new(false);
    let max_defects = if args.report.is_some() { 10_000_000 } else { 1000 };
    // Open surfaces are valid: whether the hull is to be kept is not known here.
    let options = Options { max_defects, keep_hull: true, ..Options::default() };
    let verdict = delotet::plc::check(&plc, &options, &mut console);
    console.finish();
    let warnings = verdict?;
    report::print_warnings(&warnings);
    summary::print_line("valid", "yes");
    Ok(warnings)
}
