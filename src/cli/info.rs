//! `delotet info`.
use super::args::InfoArgs;
use super::observer::Console;
use super::{report, summary, Failure};

/// Reads a file, says what is in it, and validates it.
pub fn run(args: &InfoArgs) -> Result<(), Failure> {
    let outcome = info(args);
    report::write_if_asked(args.report.as_deref(), || match &outcome {
        Ok(()) => report::of_success(None),
        Err(failure) => report::of_error(&failure.error),
    });
    outcome
}

fn info(args: &InfoArgs) -> Result<(), Failure> {
    let plc = delotet::io::read(&args.input)?;
    summary::print_plc(&args.input, &plc);
    let mut console = Console::new(false);
    let limit = if args.report.is_some() { 10_000_000 } else { 1000 };
    let verdict = delotet::plc::check(&plc, limit, &mut console);
    console.finish();
    verdict?;
    summary::print_line("valid", "yes");
    Ok(())
}
