//! The scan that a report is of.

use crate::unit::Unit;

/// A scan as reports name it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ReportedScan {
    /// Its name.
    pub input: String,
    /// Unit of its lengths, if it was told.
    pub unit: Option<Unit>,
    /// What its reader warned of.
    pub warnings: Vec<String>,
}
