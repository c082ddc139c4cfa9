//! What `grainform synth` tells: the scan it made and the truth behind it.

use super::escape::escaped;
use super::number::{round, short};
use super::truth::TruthRecord;
use crate::digits::plural;
use crate::shapes::{Subject, SynthOptions, SyntheticScan};
use serde::Serialize;
use std::fmt;

/// A synthetic scan and the closed form it was taken from. Lengths are in the unit of the axes; of a body that has none, in
/// millimetres.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct SynthReport {
    /// Name of the body.
    pub body: &'static str,
    /// Semi-axes of a shape, or half its extents, in x, y and z; those of either side, the positive one first, of a
    /// superquadric whose octants differ.
    pub axes: Option<Vec<f64>>,
    /// Exponents n1 and n2 of a superquadric.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub exponents: Option<[f64; 2]>,
    /// Points actually made.
    pub points: usize,
    /// Layout of the directions.
    pub sampling: &'static str,
    /// Standard deviation of the radial noise, as a share of the mean radius.
    pub noise: f64,
    /// Probability of a point to be an outlier.
    pub outliers: f64,
    /// Half-opening angle of the cap that was not seen, in degrees.
    pub missing_cap: f64,
    /// Where the body's origin lies.
    pub offset: [f64; 3],
    /// Seed of everything random.
    pub seed: u64,
    /// Mean radius over all directions from the body's origin.
    pub mean_radius: f64,
    /// The figures of the closed form.
    #[serde(flatten)]
    pub truth: TruthRecord,
    /// The file written, if any.
    pub output: Option<String>,
}

impl SynthReport {
    /// The report of a scan made with these options.
    pub fn new(options: &SynthOptions, scan: &SyntheticScan, output: Option<String>) -> Self {
        let truth = &scan.truth;
        Self {
            body: options.body.name(),
            axes: options.body.semi_axes(options.axes),
            exponents: match options.body {
                Subject::Superquadric(body) => Some([body.n1()[0], body.n2()[0][0]]),
                _ => None,
            },
            points: scan.points.len(),
            sampling: options.sampling.name(),
            noise: options.noise,
            outliers: options.outliers,
            missing_cap: options.missing_cap,
            offset: options.offset.into(),
            seed: options.seed,
            mean_radius: truth.mean_radius,
            truth: TruthRecord::new(&truth.properties, truth.relative_error),
            output,
        }
    }
}

impl fmt::Display for SynthReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "body         {}", self.body)?;
        if let Some(axes) = &self.axes {
            let axes: Vec<String> = axes.iter().map(|axis| short(*axis)).collect();
            writeln!(f, "semi-axes    {}", axes.join("  "))?;
        }
        if let Some([n1, n2]) = self.exponents {
            writeln!(f, "exponents    {} and {}", round(n1), round(n2))?;
        }
        writeln!(
            f,
            "scan         {}, sampling {}, noise {} % of the mean radius, seed {}",
            plural(self.points, "point"),
            self.sampling,
            round(100.0 * self.noise),
            self.seed
        )?;
        writeln!(f, "mean radius  {}", short(self.mean_radius))?;
        write!(f, "{}", self.truth)?;
        if let Some(output) = &self.output {
            writeln!(f, "wrote        {}", escaped(output))?;
        }
        write!(
            f,
            "Exact figures of the body{}, to {:.0e}.",
            match self.axes {
                Some(_) => "",
                None => " in mm",
            },
            self.truth.relative_error
        )
    }
}
