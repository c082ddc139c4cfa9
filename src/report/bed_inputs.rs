//! What `grainform bed --dry-run` tells.

use super::number::short;
use crate::digits::plural;
use serde::Serialize;
use std::fmt;

/// The inputs that an engine has read without running them.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct BedInputsReport {
    /// The engine.
    pub engine: String,
    /// The beds.
    pub runs: Vec<BedInputsRecord>,
    /// What to know of them.
    pub warnings: Vec<String>,
}

/// The inputs of a bed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BedInputsRecord {
    /// Seed of the bed.
    pub seed: u64,
    /// Where they are.
    pub folder: String,
    /// Grains that the engine has found in them.
    pub grains: usize,
    /// Spheres of these.
    pub spheres: usize,
    /// Steps that it would run at most.
    pub most_steps: u64,
    /// Length of a step, in seconds.
    pub step_s: f64,
}

impl BedInputsReport {
    /// The report of what an engine has read.
    pub fn new(engine: &str, runs: Vec<BedInputsRecord>, warnings: Vec<String>) -> Self {
        Self {
            engine: engine.into(),
            runs,
            warnings,
        }
    }
}

impl fmt::Display for BedInputsReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lines = self.runs.iter().map(|run| {
            format!(
                "{} has read {} of {} in {}, and would run at most {} of {} s",
                self.engine,
                plural(run.grains, "grain"),
                plural(run.spheres, "sphere"),
                run.folder,
                plural(run.most_steps as usize, "step"),
                short(run.step_s)
            )
        });
        f.write_str(&lines.collect::<Vec<_>>().join("\n"))
    }
}
