//! What `grainform split` tells.

use super::number::{short, triple};
use crate::digits::plural;
use crate::scan::Split;
use crate::scan::heap::MANY;
use crate::unit::Unit;
use serde::Serialize;
use std::collections::BTreeMap;
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
    /// Heaps, or bodies of a mesh or of a segmented volume, that are too small for a grain.
    pub dust: usize,
    /// Points of these; of a segmented volume their voxels.
    pub dust_points: usize,
    #[serde(skip)]
    is_volume: bool,
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
    /// Number of points; of a segmented volume those between its voxels and others.
    pub points: usize,
    /// The heap it was cut from, a number that grains of one heap share; `null` where it was not cut.
    pub cut_from: Option<usize>,
    /// Width of the widest neck at which that heap was cut, over that of the narrower side.
    pub neck: Option<f64>,
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
                cut_from: grain.cut.map(|cut| cut.heap),
                neck: grain.cut.map(|cut| cut.neck),
                may_touch: grain.may_touch,
            })
            .collect();
        let is_volume =
            grains.iter().any(|grain| grain.label.is_some()) || !split.left_out.is_empty();
        let touching = grains.iter().filter(|grain| grain.may_touch);
        let touching = touching.map(|grain| match is_volume {
            true => format!(
                "{} has a neck, as of grains that touch, and voxels are not cut apart: if it is several, separate them \
                 in the segmentation.",
                grain.file
            ),
            false => format!(
                "{} may be several grains that touch, or one that is bent or has a waist: it was not cut.",
                grain.file
            ),
        });
        let heaps = heaps(&grains);
        let warnings = cut_apart(&heaps)
            .into_iter()
            .chain(of_many(&heaps))
            .chain(small(split))
            .chain(touching);
        let warnings: Vec<String> = warnings.collect();
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
            is_volume,
            cuts: split.cuts(),
            warnings: warnings.into_iter().chain(left_out).collect(),
            grains,
        }
    }

    /// The same with the unit of its lengths.
    pub fn in_unit(self, unit: Option<Unit>) -> Self {
        Self { unit, ..self }
    }
}

/// What was left out for its size beside the grains, where it is more than these.
fn small(split: &Split) -> Option<String> {
    (split.small > split.grains.len()).then(|| {
        format!(
            "{} heaps were left out as dust, for they are small beside what was kept: if that is a table or a box, take it out of \
             the scan, and split again.",
            split.small
        )
    })
}

/// The width of the neck of each heap that was cut, and the grains that it became.
fn heaps(grains: &[SplitGrainRecord]) -> Vec<(f64, Vec<&str>)> {
    let mut heaps: BTreeMap<usize, (f64, Vec<&str>)> = BTreeMap::new();
    for grain in grains {
        if let (Some(heap), Some(neck)) = (grain.cut_from, grain.neck) {
            let (_, files) = heaps.entry(heap).or_insert((neck, Vec::new()));
            files.push(&grain.file);
        }
    }
    heaps.into_values().collect()
}

/// Which grains were cut apart, on what evidence, and what to do if one of them was cut in two.
fn cut_apart(heaps: &[(f64, Vec<&str>)]) -> Option<String> {
    let told: Vec<String> = heaps
        .iter()
        .map(|(neck, files)| format!("{} ({:.0} %)", files.join(" from "), 100.0 * neck))
        .collect();
    (!told.is_empty()).then(|| {
        format!(
            "Cut apart at a neck, with its width beside that of the narrower side: {}. A grain that has a waist, or \
             is bent, is cut too: if one of these was one grain, split again with --uncut.",
            told.join(", ")
        )
    })
}

/// Which grains come from heaps of more than two, whose necks lie close to each other.
fn of_many(heaps: &[(f64, Vec<&str>)]) -> Option<String> {
    let many = heaps.iter().filter(|(_, files)| files.len() >= MANY);
    let files: Vec<&str> = many.flat_map(|(_, files)| files.iter().copied()).collect();
    (!files.is_empty()).then(|| {
        format!(
            "From heaps of three and more: {}. Such pieces may lack up to a tenth of their points, or have as many of \
             others, and one may be half a grain: their sizes are less certain than is told of them.",
            files.join(", ")
        )
    })
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
        let noun = if self.is_volume { "voxel" } else { "point" };
        let dust = plural(self.dust_points, noun);
        write!(
            f,
            "dust          {} of {dust} left out",
            plural(self.dust, "heap")
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grains_of_clumps_of_three_are_told_beside_those_of_pairs() {
        let grain = |file: &str, heap: Option<usize>| SplitGrainRecord {
            file: file.into(),
            label: None,
            points: 100,
            cut_from: heap,
            neck: heap.map(|_| 0.4),
            may_touch: false,
        };
        let pair = ["a", "b"].map(|file| grain(file, Some(0)));
        let chain = ["c", "d", "e"].map(|file| grain(file, Some(1)));
        let alone = [grain("f", None)];
        assert_eq!(of_many(&heaps(&[&pair[..], &alone].concat())), None);
        let all = [&pair[..], &chain, &alone].concat();
        let told = of_many(&heaps(&all)).unwrap();
        assert!(
            told.starts_with("From heaps of three and more: c, d, e. Such"),
            "{told}"
        );
        let cut = cut_apart(&heaps(&all)).unwrap();
        assert!(
            cut.contains("a from b (40 %), c from d from e (40 %)."),
            "{cut}"
        );
    }
}
