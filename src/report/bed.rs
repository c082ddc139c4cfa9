//! What `grainform bed` tells.

use super::escape::escaped;
use super::number::{short, with_error};
use super::unit::Unit;
use crate::bed::{Bed, BedSettings, Container, Fabric, Packing, fabric, packing};
use crate::scan::plural;
use serde::Serialize;
use std::fmt;

/// Beds of the same grains, each from another seed.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct BedReport {
    /// Unit of the lengths in the files of the run; the figures here are in SI units.
    pub unit: Unit,
    /// What the bed is made of.
    pub kinds: Vec<BedKindRecord>,
    /// What was asked for or, where it was not, assumed.
    pub settings: BedSettings,
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
    /// How densely it is packed.
    pub packing: Packing,
    /// Contacts, forces, directions.
    pub fabric: Fabric,
}

impl BedRunRecord {
    /// The figures of a bed.
    pub fn new(bed: &Bed, is_at_rest: bool) -> Self {
        Self {
            seed: bed.settings().seed,
            is_at_rest,
            seconds: bed.seconds(),
            steps: bed.steps(),
            packing: packing(bed),
            fabric: fabric(bed),
        }
    }
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
        let mut warnings = Vec::new();
        for run in &runs {
            if !run.is_at_rest {
                warnings.push(format!(
                    "The bed of seed {} is not at rest after {} s; its figures are those of a bed that moves.",
                    run.seed,
                    short(run.seconds)
                ));
            }
            if run.packing.core.is_none() {
                warnings.push(format!(
                    "The bed of seed {} has no core: it is too low or too narrow for places two diameters off the \
                     walls, 1.5 off the floor and one below its surface.",
                    run.seed
                ));
            }
        }
        Self {
            unit,
            kinds: kinds.collect(),
            settings: bed.settings().clone(),
            runs,
            warnings,
        }
    }

    /// The mean of a figure over all runs and its standard error, that of the mean or, of one run, the run's own;
    /// `None` if a run does not have it.
    fn mean(&self, figure: impl Fn(&BedRunRecord) -> Option<(f64, Option<f64>)>) -> Option<String> {
        let found: Vec<_> = self.runs.iter().map(figure).collect::<Option<_>>()?;
        let (mean, error) = mean_of(&found)?;
        Some(with_error(mean, error))
    }
}

/// Mean and standard error: over several figures from their spread, of one its own.
fn mean_of(figures: &[(f64, Option<f64>)]) -> Option<(f64, Option<f64>)> {
    let count = figures.len() as f64;
    match figures {
        [] => None,
        [one] => Some(*one),
        _ => {
            let mean = figures.iter().map(|(value, _)| value).sum::<f64>() / count;
            let spread = figures.iter().map(|(value, _)| (value - mean).powi(2));
            let variance = spread.sum::<f64>() / (count - 1.0);
            Some((mean, Some((variance / count).sqrt())))
        }
    }
}

impl fmt::Display for BedReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let metres = self.unit.metres();
        let length = |value: f64| format!("{} {}", short(value / metres), self.unit);
        for kinds in self.kinds.chunk_by(|one, other| one.input == other.input) {
            let range = |figure: &dyn Fn(&BedKindRecord) -> f64| {
                let figures = || kinds.iter().map(figure);
                let least = figures().fold(f64::INFINITY, f64::min);
                let [least, most] = [least, figures().fold(0.0, f64::max)].map(short);
                match least == most {
                    true => least,
                    false => format!("{least} to {most}"),
                }
            };
            let grains: usize = kinds.iter().map(|kind| kind.grains).sum();
            writeln!(
                f,
                "grains        {grains} of {}, diameter {} {} (equal volume), mass {} mg",
                escaped(&kinds[0].input),
                range(&|kind| kind.diameter_m / metres),
                self.unit,
                range(&|kind| 1e6 * kind.mass_kg)
            )?;
        }
        let container = match self.settings.container {
            Container::Box([width, depth]) => format!("box {} x {}", length(width), length(depth)),
            Container::Cylinder(radius) => format!("cylinder of diameter {}", length(2.0 * radius)),
        };
        let settings = &self.settings;
        writeln!(f, "container     {container}")?;
        writeln!(
            f,
            "material      density {} kg/m³, Young's modulus {} MPa, Poisson's ratio {}, of walls too",
            settings.density,
            1e-6 * settings.youngs_modulus_pa,
            settings.poissons_ratio
        )?;
        writeln!(
            f,
            "surface       friction {}, rolling friction {}, damping {} and {}",
            settings.friction, settings.rolling_friction, settings.damping[0], settings.damping[1]
        )?;
        if let [run] = self.runs.as_slice() {
            let way = match run.is_at_rest {
                true => "in",
                false => "not, in",
            };
            writeln!(
                f,
                "settled       {way} {} s, {}",
                short(run.seconds),
                plural(run.steps as usize, "step")
            )?;
        } else {
            writeln!(f, "runs          {}", self.runs.len())?;
        }
        let none = || "not told: the bed is too low or too narrow".to_owned();
        let fraction = |figure: Option<crate::bed::Fraction>| {
            figure.map(|fraction| (fraction.value, Some(fraction.error)))
        };
        let core = self.mean(|run| fraction(run.packing.core));
        let whole = self.mean(|run| fraction(run.packing.whole));
        let core = core.map_or_else(none, |core| {
            format!("packing fraction {core}, two diameters off the walls")
        });
        let whole = whole.map_or_else(none, |whole| {
            format!("packing fraction {whole}, from wall to wall")
        });
        writeln!(f, "core          {core}")?;
        writeln!(f, "whole         {whole}")?;
        let per_grain = |figure: &dyn Fn(&Fabric) -> f64| {
            self.mean(|run| Some((figure(&run.fabric), None)))
                .unwrap_or_else(none)
        };
        writeln!(
            f,
            "coordination  {} contacts, {} neighbours per grain",
            per_grain(&|fabric| fabric.contacts),
            per_grain(&|fabric| fabric.neighbours)
        )?;
        if let Some(forces) = self.runs.first().and_then(|run| run.fabric.forces.as_ref()) {
            let [low, _, median, _, high] = forces.quantiles.map(short);
            writeln!(
                f,
                "forces        mean {} N; 5, 50, 95 % and largest are {low}, {median}, {high} and {} times that",
                short(forces.mean),
                short(forces.largest)
            )?;
        }
        if let Some(order) = self.runs.first().and_then(|run| run.fabric.order.as_ref()) {
            let [largest, ..] = order.eigenvalues;
            writeln!(
                f,
                "long axes     order {}, vertical {} (1 upright, -0.5 flat)",
                short(largest),
                short(order.vertical)
            )?;
        }
        write!(f, "Figures after ± are standard errors")?;
        match self.runs.len() {
            1 => write!(f, " of the sampling; --seeds tells those of the bed."),
            _ => write!(
                f,
                " over the runs; forces and long axes are those of the first."
            ),
        }
    }
}
