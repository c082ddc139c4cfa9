//! The `grainform` command line.

use std::process::ExitCode;

fn main() -> ExitCode {
    grainform::cli::run()
}
