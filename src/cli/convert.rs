//! `delotet convert`.
use super::args::ConvertArgs;
use super::{paths, report, Failure};
use delotet::io::Format;
use delotet::{Error, Status};

/// Reads one surface format and writes another.
pub fn run(args: &ConvertArgs) -> Result<(), Failure> {
    paths::check_input(&args.input)?;
    paths::check_output(&args.output)?;
    if Format::of(&args.output)?.is_mesh() {
        let message = format!("{}: not a surface format", args.output.display());
        return Err(Error::new(Status::Unsupported, message).into());
    }
    // The file itself may be written anew, for it has been read then; what it refers to may not.
    let mut beside = delotet::io::sources(&args.input)?;
    beside.retain(|file| *file != args.input);
    paths::check_distinct(&beside, std::slice::from_ref(&args.output))?;
    let plc = delotet::io::read(&args.input)?;
    let warnings = delotet::io::write_surface(&args.output, &plc).map_err(|error| match error.status {
        Status::File => Failure::usage(error),
        _ => error.into(),
    })?;
    report::print_warnings(&warnings);
    Ok(())
}
