//! The `grainform` command line: typed arguments are settled, outputs are checked, then work begins.

mod args;
mod bench;
mod contact;
mod fit;
mod fitting;
mod measure;
mod mesh;
mod outputs;
mod progress;
mod search;
mod synth;
mod values;

use anyhow::{Context, Result};
use args::{Cli, Command};
use clap::Parser;
use serde::Serialize;
use std::fmt::Display;
use std::io::{self, ErrorKind, Write};
use std::process::ExitCode;

/// Bad usage or unusable input. (1 is kept for batches in which some inputs failed.)
const UNUSABLE: u8 = 2;

/// Runs the command line of this process.
pub fn run() -> ExitCode {
    let result = match Cli::parse().command {
        Command::Fit(args) => fit::run(args),
        Command::Search(args) => search::run(args),
        Command::Mesh(args) => mesh::run(args),
        Command::Measure(args) => measure::run(args),
        Command::Contact(args) => contact::run(args),
        Command::Synth(args) => synth::run(args),
        Command::Bench(args) => bench::run(args),
    };
    match result {
        Err(error) if !is_broken_pipe(&error) => {
            say(format_args!("error: {error:#}"));
            ExitCode::from(UNUSABLE)
        }
        _ => ExitCode::SUCCESS,
    }
}

/// The reader of our output has gone, as `head` does: no fault of ours.
fn is_broken_pipe(error: &anyhow::Error) -> bool {
    error
        .downcast_ref::<io::Error>()
        .is_some_and(|error| error.kind() == ErrorKind::BrokenPipe)
}

/// Prints a result to standard output.
fn print(text: impl Display) -> Result<()> {
    writeln!(io::stdout().lock(), "{text}").context("cannot write to standard output")
}

/// Prints a record to standard output as JSON.
fn print_json(record: &impl Serialize) -> Result<()> {
    print(serde_json::to_string_pretty(record)?)
}

/// Tells the user something on standard error; where that is closed there is nobody to tell.
fn say(text: impl Display) {
    let _ = writeln!(io::stderr().lock(), "{text}");
}

fn warn(warnings: &[String]) {
    for warning in warnings {
        say(format_args!("warning: {warning}"));
    }
}
