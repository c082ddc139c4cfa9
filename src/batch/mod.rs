//! Many scans, one row each: fitted, measured, and written as a table that is the same whatever happens on the way.
//!
//! ```text
//! inputs -> queue (labels) -> grain (one scan: fit, measures) -> journal -> results -> population, comparison
//! ```
//!
//! Each grain is worked on by one thread. Its row goes into a journal as soon as it is known, and the final files are
//! written from the journal in the order of the inputs: so they do not depend on the number of threads, nor on how
//! often a run was stopped and started again.

mod alike;
mod columns;
mod comparison;
mod csv_table;
mod error;
mod gaps;
mod grain;
mod in_the_way;
mod inputs;
mod interval;
mod journal;
mod left_over;
mod lot;
mod names;
mod outliers;
mod own_error;
mod population;
mod queue;
mod results;
mod run;
mod saved;
mod shown;
mod statistics;
mod table;

pub(crate) use alike::doubts;
pub(crate) use columns::measures;
pub(crate) use comparison::{Comparison, compare};
pub(crate) use csv_table::{CsvError, csv_table, texts};
pub(crate) use error::TableError;
pub(crate) use gaps::Gaps;
pub(crate) use grain::Settings;
pub(crate) use inputs::{Inputs, check_folder, inputs};
pub(crate) use left_over::model;
pub(crate) use names::names;
pub(crate) use outliers::{Outlier, outliers_of};
pub(crate) use population::Population;
pub(crate) use run::{Batch, Progress, Step, run};
pub(crate) use saved::{RowKey, SavedModels};
pub(crate) use table::{read_lot, read_results, results_table};
