//! Standard output, collected and written at once, so that a full disk is noticed.
use super::Failure;
use delotet::{Error, Status};
use std::fmt::Write as _;
use std::io::{ErrorKind, Write as _};

/// Lines for standard output.
#[derive(Default)]
pub struct Page(String);

impl Page {
    /// Adds a line: a label and a text.
    pub fn line(&mut self, label: &str, text: impl std::fmt::Display) {
        let _ = writeln!(self.0, "{label:<14} {text}");
    }

    /// Adds a line of text alone.
    pub fn text(&mut self, text: impl std::fmt::Display) {
        let _ = writeln!(self.0, "{text}");
    }

    /// Writes all lines. A reader that stops early is no error: `| head` is common.
    pub fn print(&self) -> Result<(), Failure> {
        let mut out = std::io::stdout().lock();
        finish(out.write_all(self.0.as_bytes()).and_then(|()| out.flush()))
    }
}

/// The outcome of writing to standard output.
pub fn finish(outcome: std::io::Result<()>) -> Result<(), Failure> {
    match outcome {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            let message = format!("standard output: cannot write: {error}");
            Err(Failure::usage(Error::new(Status::File, message)))
        }
        _ => Ok(()),
    }
}

/// Writes a line to standard error. A failure to do so is ignored: there is nowhere to report it.
pub fn tell(line: std::fmt::Arguments<'_>) {
    let _ = writeln!(std::io::stderr().lock(), "{line}");
}
