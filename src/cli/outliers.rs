//! Grains that are worth a look, on the terminal.

use super::console::Console;
use crate::batch::Outlier;
use crate::report::escaped;
use anyhow::Result;

/// Outliers that are told of a lot.
const MOST_TOLD: usize = 20;

/// Prints the outliers of a lot, which is named so, and where to find those that are too many.
pub(super) fn print_outliers(
    outliers: &[Outlier],
    of_lot: &str,
    elsewhere: &str,
    console: Console,
) -> Result<()> {
    for outlier in outliers.iter().take(MOST_TOLD) {
        let (path, reason) = (escaped(&outlier.path), &outlier.reason);
        console.print(format_args!("worth a look{of_lot}: {path}, {reason}"))?;
    }
    match outliers.len().saturating_sub(MOST_TOLD) {
        0 => Ok(()),
        more => console.print(format_args!("and {more} more {elsewhere}")),
    }
}
