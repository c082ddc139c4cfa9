//! What `grainform synth tray` tells.

use super::escape::escaped;
use super::number::round;
use crate::digits::plural;
use crate::shapes::{Origin, SyntheticTray, TrayOptions};
use serde::Serialize;
use std::fmt;

/// A synthetic tray. Lengths are in millimetres.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct TrayReport {
    /// Number of grains.
    pub grains: usize,
    /// Pairs of grains that touch, counted from 1.
    pub touching: Vec<[usize; 2]>,
    /// Points actually made, ...
    pub points: usize,
    /// ... those of the plane ...
    pub plane_points: usize,
    /// ... and those of dust.
    pub dust_points: usize,
    /// Standard deviation of the noise, as a share of a radius of 4 mm.
    pub noise: f64,
    /// Seed of everything random.
    pub seed: u64,
    /// The file written, if any.
    pub output: Option<String>,
}

impl TrayReport {
    /// The report of a tray made with these options.
    pub fn new(options: &TrayOptions, tray: &SyntheticTray, output: Option<String>) -> Self {
        let count = |of: Origin| tray.origins.iter().filter(|origin| **origin == of).count();
        Self {
            grains: options.grains,
            touching: tray
                .touching
                .iter()
                .map(|pair| pair.map(|grain| grain + 1))
                .collect(),
            points: tray.points.len(),
            plane_points: count(Origin::Plane),
            dust_points: count(Origin::Dust),
            noise: options.noise,
            seed: options.seed,
            output,
        }
    }
}

impl fmt::Display for TrayReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "tray         {} grains, of which {} touch",
            self.grains,
            plural(self.touching.len(), "pair")
        )?;
        write!(
            f,
            "scan         {}, {} of the plane and {} of dust, noise {} % of 4 mm, seed {}",
            plural(self.points, "point"),
            self.plane_points,
            self.dust_points,
            round(100.0 * self.noise),
            self.seed
        )?;
        match &self.output {
            Some(output) => write!(f, "\nwrote        {}", escaped(output)),
            None => Ok(()),
        }
    }
}
