//! Who is told what: results go to standard output, unless a file is written there; notes, warnings and errors
//! to standard error.

use super::progress::Progress;
use super::streams::{put, put_json, say};
use super::wrap;
use crate::report::escaped;
use anyhow::Result;
use serde::Serialize;
use std::fmt::Display;
use std::io;

/// How much is told, and where.
#[derive(Debug, Clone, Copy)]
pub(super) struct Console {
    quiet: bool,
    verbose: bool,
    /// A file is written to standard output: a summary goes to standard error.
    is_stdout_taken: bool,
}

impl Console {
    pub(super) fn new(quiet: bool, verbose: bool) -> Self {
        Self {
            quiet,
            verbose,
            is_stdout_taken: false,
        }
    }

    /// The same, with standard output for a file if it is `taken`.
    pub(super) fn beside(self, taken: bool) -> Self {
        Self {
            is_stdout_taken: taken,
            ..self
        }
    }

    pub(super) fn is_quiet(self) -> bool {
        self.quiet
    }

    pub(super) fn is_verbose(self) -> bool {
        self.verbose
    }

    /// Prints a summary for a person, its lines wrapped to the terminal.
    pub(super) fn print(self, text: impl Display) -> Result<()> {
        if self.quiet {
            return Ok(());
        }
        if self.is_stdout_taken {
            say(text);
            return Ok(());
        }
        let width = wrap::width(&io::stdout());
        put(wrap::to_width(&text.to_string(), width))
    }

    /// Tells a report: as JSON where that is asked for, else for a person, with the names of what was written and with
    /// warnings.
    pub(super) fn tell(
        self,
        report: &(impl Serialize + Display),
        is_json: bool,
        written: impl IntoIterator<Item = String>,
        warnings: &[String],
    ) -> Result<()> {
        if is_json {
            return put_json(report);
        }
        self.print(report)?;
        for name in written {
            self.wrote(&name)?;
        }
        self.warn(warnings);
        Ok(())
    }

    /// Prints that a file was written.
    pub(super) fn wrote(self, name: &str) -> Result<()> {
        self.print(format_args!("wrote {}", escaped(name)))
    }

    pub(super) fn warn(self, warnings: &[String]) {
        for warning in warnings {
            self.note("warning", warning);
        }
    }

    /// Tells something of a kind, such as `note`.
    pub(super) fn note(self, kind: &str, text: &str) {
        if !self.quiet {
            say(format_args!("{kind}: {}", escaped(text)));
        }
    }

    /// What tells of the work: lines if asked for, else a bar on a terminal.
    pub(super) fn progress(self) -> Progress {
        match (self.quiet, self.verbose) {
            (true, _) => Progress::hidden(),
            (_, true) => Progress::lines(),
            _ => Progress::bar(),
        }
    }

    /// The columns of the terminal that a table is printed on; none where it is not a terminal.
    pub(super) fn width(self) -> Option<usize> {
        match self.is_stdout_taken {
            true => wrap::width(&io::stderr()),
            false => wrap::width(&io::stdout()),
        }
    }
}
