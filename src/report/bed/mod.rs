//! What `grainform bed` tells.

mod means;
mod text;
mod warnings;

use crate::bed::{Bed, BedSettings, Fabric, Packing, packing};
use crate::unit::Unit;
pub use means::{BedMean, BedMeans};
use serde::Serialize;
use std::collections::BTreeSet;

/// Beds of the same grains, each from another seed.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct BedReport {
    /// Unit of the lengths in the files of the run; the figures here are in SI units.
    pub unit: Unit,
    /// What the bed is made of.
    pub kinds: Vec<BedKindRecord>,
    /// What was asked for or, where it was not, assumed; the seed is that of the first bed.
    pub settings: BedSettings,
    /// Whether the faces of a mesh are walls too.
    pub has_mesh: bool,
    /// The figures over all beds.
    pub means: BedMeans,
    /// The beds.
    pub runs: Vec<BedRunRecord>,
    /// What to know of these figures.
    pub warnings: Vec<String>,
}

/// A kind of grain.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct BedKindRecord {
    /// The model.
    pub input: String,
    /// How many grains of it.
    pub grains: usize,
    /// Diameter of the sphere of equal volume, in metres.
    pub diameter_m: f64,
    /// Mass, in kilograms.
    pub mass_kg: f64,
}

/// A bed that has settled.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct BedRunRecord {
    /// Its seed.
    pub seed: u64,
    /// Whether it came to rest before its time was up.
    pub is_at_rest: bool,
    /// Simulated time, in seconds.
    pub seconds: f64,
    /// Steps of the simulation.
    pub steps: u64,
    /// Energy of motion and height, as a share of that at the start.
    pub energy_left: f64,
    /// How densely it is packed; without fractions where grains overlap too much, and beside a mesh, for it is not known
    /// how much of the container is room for grains.
    pub packing: Packing,
    /// Contacts, forces, directions.
    pub fabric: Fabric,
}

impl BedRunRecord {
    /// The figures of a bed that ended after so many seconds and steps.
    pub fn new(bed: &Bed, is_at_rest: bool, seconds: f64, steps: u64, fabric: Fabric) -> Self {
        let mut run = Self {
            seed: bed.settings().seed,
            is_at_rest,
            seconds,
            steps,
            energy_left: bed.energy_left(),
            packing: Packing::without_fractions(bed),
            fabric,
        };
        if !run.is_crushed() && !bed.has_mesh() {
            run.packing = packing(bed);
        }
        run
    }
}

/// Tells models of whose sizes none has a grain.
fn without_grains(kinds: &[BedKindRecord]) -> impl Iterator<Item = String> {
    let grains = |input: &str| -> usize {
        let own = kinds.iter().filter(|kind| kind.input == input);
        own.map(|kind| kind.grains).sum()
    };
    let inputs: BTreeSet<&str> = kinds.iter().map(|kind| kind.input.as_str()).collect();
    inputs
        .into_iter()
        .filter(move |input| grains(input) == 0)
        .map(|input| {
            format!("The bed has no grain of {input}: its share of so few grains is none.")
        })
}

impl BedReport {
    /// The report of these runs; `inputs` names the models in the order of the beds' kinds, and one bed stands for all.
    pub fn new(inputs: Vec<String>, unit: Unit, bed: &Bed, runs: Vec<BedRunRecord>) -> Self {
        let kinds = bed.kinds().iter().zip(inputs).enumerate();
        let kinds = kinds.map(|(at, (kind, input))| BedKindRecord {
            input,
            grains: bed.bodies().iter().filter(|body| body.kind == at).count(),
            diameter_m: 2.0 * kind.radius(),
            mass_kg: kind.mass(),
        });
        let settings = BedSettings {
            seed: runs.first().map_or(bed.settings().seed, |run| run.seed),
            ..bed.settings().clone()
        };
        let has_mesh = bed.has_mesh();
        let kinds: Vec<BedKindRecord> = kinds.collect();
        let of_runs = runs
            .iter()
            .flat_map(|run| run.warnings(&settings, has_mesh));
        let warnings = without_grains(&kinds).chain(of_runs).collect();
        Self {
            unit,
            kinds,
            means: BedMeans::of(&runs),
            warnings,
            settings,
            has_mesh,
            runs,
        }
    }
}
