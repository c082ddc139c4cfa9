//! What `grainform split` tells.

use super::number::{short, triple};
use super::unit::Unit;
use crate::digits::plural;
use crate::scan::Split;
use serde::Serialize;
use std::fmt;

/// The grains that a scan was split into.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct SplitReport {
    /// The scan.
    pub input: String,
    /// Unit of lengths, where it was told.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<Unit>,
    /// How far neighbours of one surface are apart at most; `null` of meshes.
    pub distance: Option<f64>,
    /// The plane that the grains lay on; `null` where there is none.
    pub plane: Option<PlaneRecord>,
    /// Clumps, or parts of a mesh, that are too small for a grain.
    pub dust: usize,
    /// Points of these.
    pub dust_points: usize,
    /// Places where grains that touched were cut apart.
    pub cuts: usize,
    /// The grains, in the order of their names.
    pub grains: Vec<SplitGrainRecord>,
    /// What is odd: whole sentences.
    pub warnings: Vec<String>,
}

/// The plane that grains lay on.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct PlaneRecord {
    /// A point of it.
    pub point: [f64; 3],
    /// The unit normal, towards the grains.
    pub normal: [f64; 3],
    /// Points nearer than this lie on it.
    pub reach: f64,
    /// Points that were left out with it.
    pub points: usize,
}

/// One grain.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct SplitGrainRecord {
    /// Name of its file.
    pub file: String,
    /// Its label in a segmented volume.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub label: Option<i64>,
    /// Number of points.
    pub points: usize,
    /// Whether it may be several that touch.
    pub may_touch: bool,
}

impl SplitReport {
    /// The report of a split, the grains of which have these names.
    pub fn new(input: String, split: &Split, files: Vec<String>) -> Self {
        let grains: Vec<SplitGrainRecord> = split
            .grains
            .iter()
            .zip(files)
            .map(|(grain, file)| SplitGrainRecord {
                file,
                label: grain.label,
                points: grain.scan.points().len(),
                may_touch: grain.may_touch,
            })
            .collect();
        let touching = grains.iter().filter(|grain| grain.may_touch);
        let warnings = touching.map(|grain| {
            format!(
                "{} may be several grains that touch, or is bent: no neck was found to cut it at.",
                grain.file
            )
        });
        let is_volume = split.grains.iter().any(|grain| grain.label.is_some());
        let steps = is_volume.then(|| {
            "The files hold the steps between voxels, which a fit of them takes for the grain's own: fit the image itself \
             for figures, with --label or by batch."
                .to_owned()
        });
        let left_out = split
            .left_out
            .iter()
            .map(|reason| format!("Left out: {reason}."));
        Self {
            input,
            unit: None,
            distance: split.distance,
            plane: split.plane.map(|plane| PlaneRecord {
                point: plane.point.coords.into(),
                normal: plane.normal.into_inner().into(),
                reach: plane.reach,
                points: split.plane_points,
            }),
            dust: split.dust,
            dust_points: split.dust_points,
            cuts: split.cuts,
            warnings: steps.into_iter().chain(warnings).chain(left_out).collect(),
            grains,
        }
    }

    /// The same with the unit of its lengths.
    pub fn in_unit(self, unit: Option<Unit>) -> Self {
        Self { unit, ..self }
    }
}

impl fmt::Display for SplitReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let unit = self.unit.map_or(String::new(), |unit| format!(" {unit}"));
        let cuts = match self.cuts {
            0 => String::new(),
            cuts => format!(", {} cut apart", plural(cuts, "pair")),
        };
        writeln!(f, "grains        {}{cuts}", self.grains.len())?;
        let points = self.grains.iter().map(|grain| grain.points);
        if let (Some(least), Some(most)) = (points.clone().min(), points.max()) {
            writeln!(f, "points        {least} to {most} per grain")?;
        }
        if let Some(plane) = &self.plane {
            writeln!(
                f,
                "plane         {} within {}{unit} of it, normal {}",
                plural(plane.points, "point"),
                short(plane.reach),
                triple(plane.normal)
            )?;
        }
        let dust = plural(self.dust_points, "point");
        write!(
            f,
            "dust          {} of {dust} left out",
            plural(self.dust, "clump")
        )?;
        match self.distance {
            Some(distance) => write!(
                f,
                "\nneighbours    are at most {}{unit} apart, as the points themselves tell",
                short(distance)
            ),
            None => Ok(()),
        }
    }
}
