//! The `grainform` command line: typed arguments are settled, outputs are checked, then work begins.

mod args;
mod batch;
mod bed;
mod bench;
mod candidates;
mod clump;
mod compare;
mod console;
mod contact;
mod count;
mod export_dem;
mod fit;
mod fitting;
mod idle;
mod inputs;
mod lengths;
mod materials;
mod measure;
mod mesh;
mod negative;
mod numbers;
mod outliers;
mod outputs;
mod placed;
mod progress;
mod report;
mod search;
mod shell;
#[cfg(unix)]
mod signals;
mod solid;
mod split;
mod streams;
mod superquadric;
mod synth;
mod threads;
mod usage;
mod values;
mod wrap;

use anyhow::Result;
use args::Command;
use console::Console;
use std::io::{self, ErrorKind};
use std::process::ExitCode;
use streams::say_error;

/// Bad usage or unusable input.
const UNUSABLE: u8 = 2;

/// A batch is done, but some of its inputs failed.
const SOME_FAILED: u8 = 1;

/// Runs the command line of this process.
pub fn run() -> ExitCode {
    let cli = match usage::parse() {
        Ok(cli) => cli,
        Err(code) => return code,
    };
    #[cfg(unix)]
    signals::outlive_large_files();
    #[cfg(unix)]
    let ready = signals::watch();
    #[cfg(not(unix))]
    let ready = Ok(());
    let console = Console::new(cli.quiet, cli.verbose);
    let result = ready.and_then(|()| done(cli.command, console));
    match result {
        Err(error) if !is_broken_pipe(&error) => {
            say_error(&sentence(&error));
            ExitCode::from(match error.is::<batch::SomeFailed>() {
                true => SOME_FAILED,
                false => UNUSABLE,
            })
        }
        _ => ExitCode::SUCCESS,
    }
}

fn done(command: Command, console: Console) -> Result<()> {
    match command {
        Command::Fit(args) => fit::run(args, console),
        Command::Search(args) => search::run(args, console),
        Command::Mesh(args) => mesh::run(args, console),
        Command::Measure(args) => measure::run(args, console),
        Command::Contact(args) => contact::run(args, console),
        Command::Clump(args) => clump::run(args, console),
        Command::ExportDem(args) => export_dem::run(args, console),
        Command::Synth(args) => synth::run(args, console),
        Command::Split(args) => split::run(args, console),
        Command::Batch(args) => batch::run(args, console),
        Command::Compare(args) => compare::run(args, console),
        Command::Bed(args) => bed::run(args, console),
        Command::Bench(args) => bench::run(args, console),
        Command::Report(args) => report::run(args, console),
        Command::Completions(args) => shell::completions(&args),
        Command::Man(args) => shell::man(&args),
    }
}

/// An error and its causes one after the other; a cause that was told with what it led to is not told again.
fn sentence(error: &anyhow::Error) -> String {
    let mut told = error.to_string();
    for cause in error.chain().skip(1).map(ToString::to_string) {
        if !told.contains(&cause) {
            told += &format!(": {cause}");
        }
    }
    told
}

/// The reader of our output has gone, as `head` does: no fault of ours.
fn is_broken_pipe(error: &anyhow::Error) -> bool {
    error.chain().any(|cause| {
        cause
            .downcast_ref::<io::Error>()
            .is_some_and(|error| error.kind() == ErrorKind::BrokenPipe)
    })
}
