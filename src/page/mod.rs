//! A report as one HTML page that needs nothing else: grains that can be turned, maps, measures, tables of results.
//!
//! What is shown is a record in JSON within the page; scripts of our own draw it. No name or number becomes part of the
//! page in any other way, so that nothing in a scan can run there.

mod assemble;
mod bench;
mod definitions;
mod error;
mod grain;
mod lot;
mod measures;
mod packed;
mod search;
mod surfaces;
mod truth;

pub(crate) use assemble::write_page;
pub(crate) use bench::BenchPart;
pub(crate) use grain::{GrainPart, Subject};
pub(crate) use lot::LotPart;
pub(crate) use measures::MeasureRow;
pub(crate) use search::SearchPart;

use serde::Serialize;

/// What a page shows.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct Page {
    /// Version of grainform.
    pub version: &'static str,
    /// The command that made it.
    pub command: String,
    /// Grains, each with a part of its own.
    pub grains: Vec<GrainPart>,
    /// Folders of results, likewise.
    pub lots: Vec<LotPart>,
}
