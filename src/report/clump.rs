//! What `grainform clump` tells, and saves.

use super::labels::Labels;
use super::number::{percent, short, triple, with_error};
use crate::clump::Clump;
use crate::digits::plural;
use crate::measure::Ball;
use crate::unit::Unit;
use serde::Serialize;
use std::fmt;
use std::io::{self, Write};

/// A clump and how near it is to its grain: the object that is printed, and the content of a file.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ClumpReport {
    /// The scan or model.
    pub input: String,
    /// Unit of lengths, where it was told.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<Unit>,
    /// The spheres, in the frame of the scan.
    pub spheres: Vec<ClumpSphere>,
    /// Root mean square over the grain's surface of the distance to the clump's along the grain's normal.
    pub rms: f64,
    /// The same as a share of the equivalent radius.
    pub relative_rms: f64,
    /// The radius of the sphere of the grain's volume.
    pub equivalent_radius: f64,
    /// Volume of the clump over that of the grain, less one.
    pub volume_error: f64,
    /// Volume of the grain.
    pub volume: f64,
    /// Its standard error; `null` where there is none.
    pub volume_standard_error: Option<f64>,
    /// Centroid of the grain.
    pub centroid: [f64; 3],
    /// Inertia of the grain about its centroid at density one, along the axes of the scan.
    pub inertia: [[f64; 3]; 3],
    /// What is odd about a scan: whole sentences.
    pub warnings: Vec<String>,
}

/// A sphere of a clump.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ClumpSphere {
    /// Centre.
    pub x: f64,
    /// Centre.
    pub y: f64,
    /// Centre.
    pub z: f64,
    /// Radius.
    pub r: f64,
}

impl ClumpReport {
    /// The report of a clump of an input.
    pub fn new(input: String, clump: &Clump, unit: Option<Unit>, warnings: Vec<String>) -> Self {
        let sphere = |ball: &Ball| ClumpSphere {
            x: ball.centre.x,
            y: ball.centre.y,
            z: ball.centre.z,
            r: ball.radius,
        };
        let equivalent_radius = clump.equivalent_radius();
        Self {
            input,
            unit,
            spheres: clump.spheres.iter().map(sphere).collect(),
            rms: clump.rms,
            relative_rms: clump.rms / equivalent_radius,
            equivalent_radius,
            volume_error: clump.volume_error,
            volume: clump.grain.volume,
            volume_standard_error: None,
            centroid: clump.grain.centroid.into(),
            inertia: clump.grain.inertia.into(),
            warnings,
        }
    }

    /// The same with how well the volume of the grain is known.
    #[must_use]
    pub fn with_volume_error(self, volume_standard_error: Option<f64>) -> Self {
        Self {
            volume_standard_error,
            ..self
        }
    }

    /// Writes the spheres as CSV: x, y, z and r, a row each.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write_csv(&self, writer: &mut (impl Write + ?Sized)) -> io::Result<()> {
        writeln!(writer, "x,y,z,r")?;
        for ClumpSphere { x, y, z, r } in &self.spheres {
            writeln!(writer, "{x},{y},{z},{r}")?;
        }
        Ok(())
    }
}

impl fmt::Display for ClumpReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let labels = Labels(self.unit);
        let radii = self.spheres.iter().map(|sphere| sphere.r);
        let least = radii.clone().fold(f64::INFINITY, f64::min);
        let largest = radii.fold(0.0, f64::max);
        let radii = match self.spheres.len() {
            1 => format!("radius {}", short(least)),
            _ => format!("radii {} to {}", short(least), short(largest)),
        };
        writeln!(
            f,
            "clump         {}, {radii}{}",
            plural(self.spheres.len(), "sphere"),
            labels.length()
        )?;
        writeln!(
            f,
            "difference    RMS {}{} ({:.3} % of the equivalent radius) along the grain's normals",
            short(self.rms),
            labels.length(),
            100.0 * self.relative_rms
        )?;
        writeln!(
            f,
            "volume        {} (known to 0.01 %) beside the grain's {}{}",
            percent(self.volume_error),
            with_error(self.volume, self.volume_standard_error),
            labels.volume()
        )?;
        write!(
            f,
            "centre        {}{} (mass, centre and inertia are the grain's)",
            triple(self.centroid),
            labels.length()
        )
    }
}
