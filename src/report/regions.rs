//! Where two surfaces of any kind overlap that are placed beside each other, and the forces there.

use super::contact::beyond_hertz;
use super::escape::escaped;
use super::hertz::HertzLaw;
use super::number::{short, triple};
use super::placed::NO_ERRORS;
use super::unit::{Labels, Unit};
use crate::contact::{ContactRegion, ContactRegions, VolumeLaw};
use crate::digits::plural;
use serde::Serialize;
use std::fmt;

/// By which law a normal force is told.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum NormalLaw {
    /// Hertz: of the depth and the curvatures at its two points.
    Hertz(HertzLaw),
    /// Of the shared volume; it keeps energy.
    Volume(VolumeLaw),
}

/// All regions in which two bodies overlap, the largest volume first; lengths are in the unit of their scans.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct RegionsReport {
    /// The first body.
    pub first: String,
    /// The second body.
    pub second: String,
    /// Unit of the scans' lengths, if it was told.
    pub unit: Option<Unit>,
    /// Where they overlap; nothing if they are apart.
    pub regions: Vec<RegionRecord>,
    /// Triangles of both bodies to begin with.
    pub triangles: usize,
    /// Of these, triangles that were left out at once.
    pub triangles_skipped: usize,
    /// Places of the surfaces that were evaluated beyond those of these triangles.
    pub places_evaluated: usize,
    /// Why these figures have no standard errors.
    pub no_standard_errors: &'static str,
    /// What to know of these figures.
    pub warnings: Vec<String>,
}

/// One region, in the frame of the first body's scan.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct RegionRecord {
    /// The middle of what they share.
    pub point: [f64; 3],
    /// The unit normal from the first body to the second.
    pub normal: [f64; 3],
    /// How far they overlap along the normal.
    pub depth: f64,
    /// The volume they share.
    pub volume: f64,
    /// By how much its integration may be off.
    pub volume_error: f64,
    /// Principal curvatures of both bodies there, the larger first; `null` where the region has no deepest points.
    pub principal_curvatures: Option<[[f64; 2]; 2]>,
    /// Normal force in newtons; `null` where none was asked for, or the law has none.
    pub normal_force_n: Option<f64>,
}

impl RegionsReport {
    /// The report of these regions.
    pub fn new(
        first: String,
        second: String,
        unit: Option<Unit>,
        found: &ContactRegions,
        law: Option<&NormalLaw>,
    ) -> Self {
        let mut warnings = Vec::new();
        let regions = found.regions.iter().map(|region| RegionRecord {
            point: region.point.coords.into(),
            normal: region.normal.into(),
            depth: region.depth,
            volume: region.volume,
            volume_error: region.volume_error,
            principal_curvatures: region
                .curvatures
                .as_ref()
                .map(|pair| pair.each_ref().map(|curvature| curvature.principal)),
            normal_force_n: law.and_then(|law| law.force_n(region, &mut warnings)),
        });
        Self {
            first,
            second,
            unit,
            regions: regions.collect(),
            triangles: found.work.triangles,
            triangles_skipped: found.work.skipped,
            places_evaluated: found.work.evaluated,
            no_standard_errors: NO_ERRORS,
            warnings,
        }
    }
}

impl NormalLaw {
    fn force_n(&self, region: &ContactRegion, warnings: &mut Vec<String>) -> Option<f64> {
        let law = match self {
            Self::Volume(law) => {
                let share = region.depth / law.effective_radius();
                let radius = "effective radius of the bodies' volumes";
                warnings.extend(beyond_hertz("The depth", share, radius).map(|told| told + "."));
                return Some(law.force_n(region).norm());
            }
            Self::Hertz(law) => law,
        };
        let Some(curvatures) = &region.curvatures else {
            warnings.push("No force by Hertz: a region has no two points whose line is normal to both surfaces.".into());
            return None;
        };
        law.force_n(region.depth, curvatures, warnings)
    }
}

impl fmt::Display for RegionsReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let labels = Labels(self.unit);
        writeln!(f, "first         {}", escaped(&self.first))?;
        writeln!(f, "second        {}", escaped(&self.second))?;
        write!(f, "contact       ")?;
        match self.regions.len() {
            0 => writeln!(f, "none: they are apart")?,
            count => writeln!(f, "at {}", plural(count, "place"))?,
        }
        for region in &self.regions {
            writeln!(
                f,
                "touched at    {}{}",
                triple(region.point),
                labels.length()
            )?;
            writeln!(f, "  normal      {}", triple(region.normal))?;
            writeln!(
                f,
                "  depth       {}{}",
                short(region.depth),
                labels.length()
            )?;
            writeln!(
                f,
                "  volume      {}{}, integrated to {:.1e}",
                short(region.volume),
                labels.volume(),
                region.volume_error
            )?;
            if let Some(force) = region.normal_force_n {
                writeln!(f, "  force       {} N", short(force))?;
            }
        }
        write!(
            f,
            "looked at     {} of {} triangles, {} places beyond them",
            self.triangles - self.triangles_skipped,
            self.triangles,
            self.places_evaluated
        )?;
        match self.regions.as_slice() {
            [] => Ok(()),
            _ => write!(f, "\n{}", self.no_standard_errors),
        }
    }
}
