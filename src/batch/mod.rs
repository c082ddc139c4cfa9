//! Many scans, one row each: fitted, measured, and written as a table that is the same whatever happens on the way.
//!
//! ```text
//! inputs -> grain (one scan: fit, measures) -> journal -> results -> population, comparison
//! ```
//!
//! Each grain is worked on by one thread. Its row goes into a journal as soon as it is known, and the final files are
//! written from the journal in the order of the inputs: so they do not depend on the number of threads, nor on how
//! often a run was stopped and started again.

mod columns;
mod comparison;
mod error;
mod grain;
mod inputs;
mod journal;
mod population;
mod results;
mod run;
mod table;

pub use columns::{Column, Kind, columns};
pub use comparison::{Comparison, compare};
pub use error::{BatchError, TableError};
pub use grain::Settings;
pub use inputs::inputs;
pub use journal::Row;
pub use population::{Outlier, Population, Statistics};
pub(crate) use run::names;
pub use run::{Batch, Done, Progress, run};
pub use table::{Lot, read_lot};
