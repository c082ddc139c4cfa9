//! Lines on standard output and standard error.

use super::wrap;
use crate::report::escaped;
use anyhow::{Context, Result};
use serde::Serialize;
use std::fmt::Display;
use std::io::{self, Write};

/// Prints text to standard output.
pub(super) fn put(text: impl Display) -> Result<()> {
    writeln!(io::stdout().lock(), "{text}").context("cannot write to standard output")
}

/// Prints a record to standard output as JSON.
pub(super) fn put_json(record: &impl Serialize) -> Result<()> {
    put(serde_json::to_string_pretty(record)?)
}

/// Tells the user something on standard error, wrapped to the terminal; where that is closed there is nobody to tell.
pub(super) fn say(text: impl Display) {
    let text = wrap::to_width(&text.to_string(), wrap::width(&io::stderr()));
    let _ = writeln!(io::stderr().lock(), "{text}");
}

/// Tells why the command failed, on one line where it is not wrapped.
pub(super) fn say_error(text: &str) {
    say(format_args!("error: {}", escaped(text)));
}
