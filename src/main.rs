//! The command line program: see `delotet --help`.
mod cli;

fn main() -> std::process::ExitCode {
    cli::run()
}
