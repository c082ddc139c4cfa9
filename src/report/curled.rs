//! What `grainform synth` tells of a body that no centre sees whole.

use super::escape::escaped;
use super::number::round;
use super::truth::TruthRecord;
use crate::digits::plural;
use crate::shapes::{CurledOptions, CurledScan};
use serde::Serialize;
use std::fmt;

/// A synthetic scan and the body it was taken from. Lengths are in millimetres.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct CurledReport {
    /// Name of the body.
    pub body: &'static str,
    /// Points made.
    pub points: usize,
    /// Triangles between them; none of points alone.
    pub triangles: usize,
    /// Standard deviation of the noise along normals, as a share of the radius of the ball of equal volume.
    pub noise: f64,
    /// Where the body's origin lies.
    pub offset: [f64; 3],
    /// Seed of everything random.
    pub seed: u64,
    /// The figures of the body.
    #[serde(flatten)]
    pub truth: TruthRecord,
    /// The file written, if any.
    pub output: Option<String>,
}

impl CurledReport {
    /// The report of a scan made with these options.
    pub fn new(options: &CurledOptions, scan: &CurledScan, output: Option<String>) -> Self {
        let truth = &scan.truth;
        Self {
            body: options.body.name(),
            points: scan.mesh.vertices.len(),
            triangles: scan.mesh.triangles.len(),
            noise: options.noise,
            offset: options.offset.into(),
            seed: options.seed,
            truth: TruthRecord::new(&truth.properties, truth.relative_error),
            output,
        }
    }
}

impl fmt::Display for CurledReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "body         {}", self.body)?;
        let triangles = match self.triangles {
            0 => String::new(),
            triangles => format!(", {}", plural(triangles, "triangle")),
        };
        writeln!(
            f,
            "scan         {}{triangles}, noise {} % of the radius of the ball of equal volume, seed {}",
            plural(self.points, "point"),
            round(100.0 * self.noise),
            self.seed
        )?;
        write!(f, "{}", self.truth)?;
        if let Some(output) = &self.output {
            writeln!(f, "wrote        {}", escaped(output))?;
        }
        write!(
            f,
            "Figures of the body in mm; area and volume to {:.0e}.",
            self.truth.relative_error
        )
    }
}
