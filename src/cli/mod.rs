//! The command line: arguments in, library calls, exit codes out. Imports only the library's public API.
//!
//! Exit codes: 0 done; 1 invalid input (also an INPUT that cannot be read, and a mesh that fails its check); 2 usage (also an OUTPUT,
//! report or standard output that cannot be written, and an unsupported request); 3 limit or cancel; 4 internal (also a mesh that cannot be
//! rounded to doubles). On failure only the report is written; if only a report or standard output fails, the mesh has been written.
use clap::Parser;
use delotet::{Error, Status};
use std::panic::{catch_unwind, AssertUnwindSafe};
use std::process::ExitCode;

mod args;
mod attribute;
mod check;
mod convert;
mod given;
mod info;
mod mesh;
mod observer;
mod page;
mod paths;
mod quality;
mod report;
mod sizes;
mod summary;
#[cfg(feature = "tetgen")]
mod tetgen;
mod weights;

/// Parses the arguments and runs the command.
pub fn run() -> ExitCode {
    #[cfg(feature = "tetgen")]
    if tetgen::is_called() {
        return tetgen::run(std::env::args_os().skip(1));
    }
    let args = match args::Args::try_parse() {
        Ok(args) => args,
        Err(error) if error.use_stderr() => {
            let _ = error.print();
            return ExitCode::from(2);
        }
        // Help and version.
        Err(error) => return exit(page::finish(error.print())),
    };
    #[cfg(feature = "tetgen")]
    if let args::Command::Tetgen(args) = args.command {
        return tetgen::run(args.words);
    }
    let outcome = catch_unwind(AssertUnwindSafe(|| match args.command {
        args::Command::Mesh(args) => mesh::run(&args),
        args::Command::Refine(args) => given::refine(&args),
        args::Command::Improve(args) => given::improve(&args),
        args::Command::Check(args) => check::run(&args),
        args::Command::Info(args) => info::run(&args),
        args::Command::Convert(args) => convert::run(&args),
        #[cfg(feature = "tetgen")]
        args::Command::Tetgen(_) => Ok(()),
    }));
    match outcome {
        Ok(outcome) => exit(outcome),
        Err(_) => {
            page::tell(format_args!(
                "error: internal: the program panicked; please report it with the input"
            ));
            ExitCode::from(4)
        }
    }
}

/// Prints what failed, and returns the exit code.
fn exit(outcome: Result<(), Failure>) -> ExitCode {
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            report::print(&failure.error);
            ExitCode::from(failure.code)
        }
    }
}

/// An error and its exit code.
pub struct Failure {
    error: Error,
    code: u8,
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        let code = match error.status {
            Status::InvalidArgument | Status::Unsupported => 2,
            Status::Cancelled | Status::SteinerLimit | Status::TimeLimit | Status::MemoryLimit => 3,
            Status::TetrahedraLimit | Status::OutOfMemory | Status::TooLarge => 3,
            Status::Rounding | Status::CheckFailed | Status::Internal => 4,
            _ => 1,
        };
        Failure { error, code }
    }
}

impl Failure {
    /// An error about the arguments or OUTPUT.
    pub fn usage(error: Error) -> Self {
        let code = match error.status {
            Status::Cancelled | Status::TimeLimit | Status::MemoryLimit | Status::OutOfMemory => 3,
            _ => 2,
        };
        Failure { error, code }
    }

    /// The same error with another exit code.
    pub fn with_code(self, code: u8) -> Self {
        Failure { code, ..self }
    }
}
