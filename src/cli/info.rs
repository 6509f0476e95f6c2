//! `delotet info`.
use super::args::InfoArgs;
use super::observer::Console;
use super::page::Page;
use super::quality::Quality;
use super::{paths, report, summary, Failure};
use delotet::{Options, Warnings};

/// Reads a file, prints what is in it, and validates it.
pub fn run(args: &InfoArgs) -> Result<(), Failure> {
    paths::check_report(args.report.as_deref(), &delotet::io::sources(&args.input)?)?;
    let outcome = info(args);
    report::write_if_asked(args.report.as_deref(), outcome, |w| {
        report::of_success(None, &Quality::default(), w)
    })
    .map(|_| ())
}

fn info(args: &InfoArgs) -> Result<Warnings, Failure> {
    paths::check_input(&args.input)?;
    let plc = delotet::io::read(&args.input)?;
    let mut page = Page::default();
    summary::describe_plc(&mut page, &args.input, &plc);
    let mut console = Console::new(false);
    let max_defects = if args.report.is_some() { 10_000_000 } else { 1000 };
    // Open surfaces count as valid, since it is not known here whether the hull will be kept.
    let cancel = Some(console.token());
    let options = Options { max_defects, keep_hull: true, cancel, ..Options::default() };
    let verdict = delotet::plc::check(&plc, &options, &mut console);
    console.finish();
    if let Ok(warnings) = &verdict {
        report::print_warnings(warnings);
        page.line("valid", "yes");
    }
    // The contents of an invalid file are printed too; its defects matter more than a full disk.
    let printed = page.print();
    let warnings = verdict?;
    printed.map(|()| warnings)
}
