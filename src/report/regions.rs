//! Where two surfaces of any kind overlap that are placed beside each other, and the forces there.

use super::contact::beyond_hertz;
use super::escape::escaped;
use super::hertz::{Force, HertzLaw, Overlap};
use super::labels::Labels;
use super::number::{PLACED_TO, place, triple, with_error};
use super::placed::NO_ERRORS;
use crate::contact::{ContactPlace, ContactRegion, ContactRegions, VolumeLaw, told_depth};
use crate::digits::plural;
use crate::unit::Unit;
use nalgebra::Vector3;
use serde::Serialize;
use std::collections::BTreeSet;
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
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<Unit>,
    /// Where they overlap; nothing if they are apart.
    pub regions: Vec<RegionRecord>,
    /// Where they are apart by less than twice the standard error of that: there they may touch.
    pub gaps: Vec<GapRecord>,
    /// Triangles of both bodies to begin with.
    pub triangles: usize,
    /// Of these, triangles that were left out at once.
    pub triangles_skipped: usize,
    /// Places of the surfaces that were evaluated beyond those of these triangles.
    pub places_evaluated: usize,
    /// Why these figures have no standard errors; `null` if they have.
    pub no_standard_errors: Option<String>,
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
    /// How far they overlap between their deepest points, along the line that is normal to both surfaces there.
    pub depth: f64,
    /// Its standard error; `null`, as those of the others, where a surface does not tell its own or the region has no
    /// deepest points.
    pub depth_error: Option<f64>,
    /// The deepest points, of the first body and of the second; `null` where the region has none.
    pub deepest_points: Option<[[f64; 3]; 2]>,
    /// The volume they share.
    pub volume: f64,
    /// By how much its integration may be off.
    pub volume_error: f64,
    /// Its standard error; `null` also where the region is no lens.
    pub volume_standard_error: Option<f64>,
    /// Principal curvatures of both bodies there, the larger first; `null` where the region has no deepest points.
    pub principal_curvatures: Option<[[f64; 2]; 2]>,
    /// Their standard errors, of both bodies.
    pub curvature_errors: Option<[f64; 2]>,
    /// Normal force in newtons; `null` where none was asked for, the law has none, or none is vouched for.
    pub normal_force_n: Option<f64>,
    /// Its standard error.
    pub normal_force_error_n: Option<f64>,
}

/// A place where two bodies may touch, in the frame of the first body's scan.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct GapRecord {
    /// The middle between them.
    pub point: [f64; 3],
    /// The unit normal from the first body to the second.
    pub normal: [f64; 3],
    /// How far they are apart.
    pub gap: f64,
    /// Its standard error.
    pub gap_error: f64,
}

impl GapRecord {
    /// The record of a place where surfaces are apart, if their errors leave it open whether they touch.
    pub fn new(place: &ContactPlace) -> Option<Self> {
        let gap_error = place.depth_error()?;
        told_depth(-place.depth, Some(gap_error)).err()?;
        Some(Self {
            point: place.point.coords.into(),
            normal: place.normal.into(),
            gap: -place.depth,
            gap_error,
        })
    }
}

impl RegionsReport {
    /// The report of these regions and gaps.
    pub fn new(
        first: String,
        second: String,
        unit: Option<Unit>,
        found: &ContactRegions,
        gaps: Vec<GapRecord>,
        law: Option<&NormalLaw>,
    ) -> Self {
        let mut warnings = Vec::new();
        let record = |region: &ContactRegion| {
            let force = law.and_then(|law| law.force(region, &mut warnings));
            RegionRecord {
                point: region.point.coords.into(),
                normal: region.normal.into(),
                depth: region.depth,
                depth_error: region.depth_error(),
                deepest_points: region
                    .deepest
                    .map(|pair| pair.map(|point| point.coords.into())),
                volume: region.volume,
                volume_error: region.volume_error,
                volume_standard_error: region.volume_standard_error(),
                principal_curvatures: region
                    .curvatures
                    .as_ref()
                    .map(|pair| pair.each_ref().map(|curvature| curvature.principal)),
                curvature_errors: region.errors.map(|pair| pair.map(|error| error.curvature)),
                normal_force_n: force.as_ref().map(|force| force.force_n),
                normal_force_error_n: force.and_then(|force| force.error_n),
            }
        };
        let regions: Vec<_> = found.regions.iter().map(record).collect();
        let of_points = found
            .regions
            .iter()
            .any(|region| region.curvatures.is_none());
        warnings.extend(of_points.then(|| DEPTH_OF_POINTS.into()));
        // What holds of several regions is said once.
        let mut said = BTreeSet::new();
        warnings.retain(|warning| said.insert(warning.clone()));
        Self {
            first,
            second,
            unit,
            regions,
            gaps,
            no_standard_errors: no_errors(&found.regions),
            triangles: found.work.triangles,
            triangles_skipped: found.work.skipped,
            places_evaluated: found.work.evaluated,
            warnings,
        }
    }
}

/// Cosine of the angle from which on directions are told apart: one degree.
const SAME_DIRECTION: f64 = 0.999_847_695_156_391_2;

/// Why a region has neither curvatures nor what follows from them.
const NO_POINTS: &str = "in a region no two points were found whose line is normal to both surfaces, or flat sides lie on each other there";

const DEPTH_OF_POINTS: &str = "Where no two points were found whose line is normal to both surfaces the depth is how far a point of one body \
     in the other is from that one's surface at most, to some ten percent: bodies that lie deep in each other part after more than that.";

/// Share by which the force of the shared volume may differ from that of Hertz before it is told.
const AS_HERTZ: f64 = 0.05;

/// What to know where the force of the shared volume is so many times that of Hertz.
fn beside_hertz(times: f64) -> Option<String> {
    let is_told = !(1.0 - AS_HERTZ..=1.0 + AS_HERTZ).contains(&times);
    is_told.then(|| {
        format!(
            "By the lens that the bodies share the force is about {times:.2} times that of Hertz, and its standard error does not hold that: \
             the law of the shared volume has the stiffness of spheres of the bodies' volumes, wherever they touch."
        )
    })
}

fn no_errors(regions: &[ContactRegion]) -> Option<String> {
    let lack = regions.iter().filter(|region| region.errors.is_none());
    let reason = |region: &ContactRegion| match region.curvatures {
        Some(_) => NO_ERRORS.into(),
        None => format!("No standard errors: {NO_POINTS}."),
    };
    lack.map(reason).next()
}

impl NormalLaw {
    fn force(&self, region: &ContactRegion, warnings: &mut Vec<String>) -> Option<Force> {
        let law = match self {
            Self::Volume(law) => {
                if let Err(error) = told_depth(region.depth, region.depth_error()) {
                    warnings.push(format!("No force: {error}."));
                    return None;
                }
                let share = region.depth / law.effective_radius();
                let radius = "effective radius of the bodies' volumes";
                warnings.extend(beyond_hertz("The depth", share, radius));
                warnings.extend(law.times_hertz(region).and_then(beside_hertz));
                let force_n = law.force_n(region).norm();
                let share = VolumeLaw::force_share(region);
                return Some(Force {
                    force_n,
                    error_n: share.map(|share| share * force_n),
                });
            }
            Self::Hertz(law) => law,
        };
        let Some(curvatures) = &region.curvatures else {
            warnings.push(format!("No force by Hertz: {NO_POINTS}."));
            return None;
        };
        let overlap = Overlap {
            depth: region.depth,
            curvatures,
            errors: region.errors.as_ref(),
            depth_error: region.depth_error(),
            times: &|known| Ok(region.times(known.relative())),
        };
        law.force(&overlap, warnings)
    }
}

impl RegionRecord {
    /// The direction from the second deepest point to the first, if it is not that of the normal.
    fn slanting(&self) -> Option<Vector3<f64>> {
        let [first, second] = self.deepest_points?.map(Vector3::from);
        let along = (first - second).normalize();
        (along.dot(&Vector3::from(self.normal)) < SAME_DIRECTION).then_some(along)
    }

    fn write(&self, f: &mut fmt::Formatter<'_>, labels: &Labels) -> fmt::Result {
        let point = place(
            self.point,
            self.depth_error.unwrap_or(PLACED_TO * self.depth),
        );
        writeln!(f, "touched at    {point}{}", labels.length())?;
        writeln!(f, "  normal      {}", triple(self.normal))?;
        let depth = with_error(self.depth, self.depth_error);
        write!(f, "  depth       {depth}{}", labels.length())?;
        if let Some(along) = self.slanting() {
            write!(f, ", along {}", triple(along.into()))?;
        }
        writeln!(f)?;
        let volume = with_error(self.volume, self.volume_standard_error);
        writeln!(
            f,
            "  volume      {volume}{}, integrated to {:.1e}",
            labels.volume(),
            self.volume_error
        )?;
        if let Some(force) = self.normal_force_n {
            let force = with_error(force, self.normal_force_error_n);
            writeln!(f, "  force       {force} N")?;
        }
        Ok(())
    }
}

impl GapRecord {
    fn write(&self, f: &mut fmt::Formatter<'_>, labels: &Labels) -> fmt::Result {
        let point = place(self.point, self.gap_error);
        writeln!(f, "may touch at  {point}{}", labels.length())?;
        writeln!(f, "  normal      {}", triple(self.normal))?;
        let gap = with_error(self.gap, Some(self.gap_error));
        writeln!(f, "  gap         {gap}{}", labels.length())
    }
}

impl fmt::Display for RegionsReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let labels = Labels(self.unit);
        writeln!(f, "first         {}", escaped(&self.first))?;
        writeln!(f, "second        {}", escaped(&self.second))?;
        write!(f, "contact       ")?;
        match (self.regions.len(), self.gaps.len()) {
            (0, 0) => writeln!(f, "none: they are apart")?,
            (0, _) => writeln!(f, "not told: they are apart by less than may be wrong")?,
            (count, _) => writeln!(f, "at {}", plural(count, "place"))?,
        }
        for region in &self.regions {
            region.write(f, &labels)?;
        }
        for gap in &self.gaps {
            gap.write(f, &labels)?;
        }
        write!(
            f,
            "looked at     {} of {} triangles, {} places beyond them",
            self.triangles - self.triangles_skipped,
            self.triangles,
            self.places_evaluated
        )?;
        match &self.no_standard_errors {
            None => Ok(()),
            Some(reason) => write!(f, "\n{reason}"),
        }
    }
}
