//! What a person or another program reads of the results: summaries as text, records for JSON,
//! tables for CSV.
//!
//! The records are the documented, stable JSON of the command line: `serde_json::to_string` of one
//! is what `--json` prints. Numbers that are not known are `null`. Their `Display` is the summary for
//! a person. Errors of area and volume are signed and relative; lengths are in the scan's unit.

mod bed;
mod bed_inputs;
mod clump;
mod contact;
mod curled;
mod escape;
mod estimate;
mod fit;
mod harmonics;
mod hertz;
mod labels;
mod measure;
mod number;
mod placed;
mod regions;
mod rule;
mod scan;
mod search;
mod split;
mod standard_errors;
mod superquadric;
mod superquadric_record;
mod synth;
mod tray;
mod truth;
mod warning;
mod withheld_reason;

pub use crate::unit::{Unit, UnitContradicted};
pub use bed::{BedKindRecord, BedMean, BedMeans, BedReport, BedRunRecord};
pub use bed_inputs::{BedInputsRecord, BedInputsReport};
pub use clump::{ClumpReport, ClumpSphere};
pub use contact::{ContactReport, Load, TouchRecord};
pub use curled::CurledReport;
#[cfg(feature = "cli")]
pub(crate) use escape::escaped;
pub use estimate::{EstimateRecord, EvaluationRecord};
#[cfg(feature = "cli")]
pub(crate) use fit::described_reference;
pub use fit::{FitReport, ReferenceRecord, Seconds, Skipped};
pub use harmonics::{largest_loss, write_harmonics, write_position_harmonics};
pub use hertz::HertzLaw;
pub use measure::{
    BoxRecord, BoxSides, CurvatureRecord, Dimensions, EllipsoidRecord, FacesRecord, FillRecord,
    Measure, MeasureReport, Measured, Measures, NotMeasured, OutlineFigures, Principal,
    ProjectionRecord, SphereRecord, Spheres, UnknownMeasure, WithErrors,
};
#[cfg(feature = "cli")]
pub(crate) use measure::{Withheld, by_reason};
#[cfg(feature = "cli")]
pub(crate) use number::round;
pub use number::{percent, short};
pub use placed::{PlacedReport, PlacedTouch};
pub use regions::{GapRecord, NormalLaw, RegionRecord, RegionsReport};
pub use scan::ReportedScan;
pub use search::{CandidateRecord, SearchReport};
pub use split::{PlaneRecord, SplitGrainRecord, SplitReport};
pub use standard_errors::StandardErrorsRecord;
pub use superquadric::{FittedScan, SuperquadricReport};
pub use superquadric_record::SuperquadricRecord;
pub use synth::SynthReport;
pub use tray::TrayReport;
pub use truth::TruthRecord;
#[cfg(feature = "cli")]
pub(crate) use warning::sentences;
