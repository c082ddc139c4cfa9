//! Why an image holds no grain that can be read.

use crate::digits::plural;
use std::collections::BTreeMap;
use std::fmt::Write;

/// Labels that an error lists.
const MOST_LISTED: usize = 12;

/// Why an image holds no grain that can be read.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum VolumeError {
    /// The header is not one of the format.
    #[error("the header has no usable {what}; export the image again")]
    Header {
        /// What is missing, or wrong.
        what: &'static str,
    },
    /// The format allows it, but it is not read here.
    #[error(
        "{what} is not read here; save the image raw or packed with gzip, with three axes and one number per voxel"
    )]
    Unsupported {
        /// What.
        what: String,
    },
    /// The voxels are in a file of another folder.
    #[error("the header names the voxels' file {name:?}, which is not beside it; move it there")]
    Elsewhere {
        /// The file that is named.
        name: String,
    },
    /// The file with the voxels cannot be read.
    #[error("the voxels in {name} cannot be read: {reason}")]
    Voxels {
        /// The file.
        name: String,
        /// Why.
        reason: String,
    },
    /// No image has this size.
    #[error("an image of {} x {} x {} voxels cannot be read", size[0], size[1], size[2])]
    Size {
        /// Numbers of voxels.
        size: [usize; 3],
    },
    /// There are fewer voxels than the header counts.
    #[error(
        "the header promises {voxels} voxels, but there are {found}; the file is cut short, copy it again"
    )]
    CutShort {
        /// Voxels promised.
        voxels: usize,
        /// Voxels there.
        found: usize,
    },
    /// The voxels would take more room than is allowed.
    #[error(
        "its voxels take more than the {limit} bytes that may be read; allow more with --max-bytes"
    )]
    TooLarge {
        /// The most bytes that may be read.
        limit: u64,
    },
    /// There are channels or times beside the three axes.
    #[error(
        "the image has {channels} and {times} beside its slices, and one of each can be read: save the slices that have \
         the labels as a stack of their own",
        channels = plural(*channels, "channel"), times = plural(*times, "time")
    )]
    Hyperstack {
        /// Numbers per voxel, each in an image of its own.
        channels: usize,
        /// Times at which all was seen.
        times: usize,
    },
    /// The description of a TIFF counts other slices than the file has.
    #[error(
        "the description promises {}, and {found} can be found; save the stack again, with all its slices in one file and \
         a header for each",
        plural(*promised, "slice")
    )]
    Slices {
        /// Slices promised.
        promised: usize,
        /// Slices found.
        found: usize,
    },
    /// The axes have lengths in several units.
    #[error(
        "the header tells lengths along the axes in several units ({}); export the image again with one for all",
        units.join(", ")
    )]
    SeveralUnits {
        /// They, each once.
        units: Vec<String>,
    },
    /// The axes of the image lie in a plane, or are not finite.
    #[error("the spacing and directions in the header are not those of a lattice in space")]
    NoLattice,
    /// A value is no whole number.
    #[error(
        "voxel {index} has the value {value}: these are grey values, not labels; segment the image first"
    )]
    GreyValues {
        /// The voxel, counted from 0.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// There are too many labels.
    #[error("there are more than {most} labels: these are grey values; segment the image first")]
    TooManyLabels {
        /// The most that are read.
        most: usize,
    },
    /// The labels lie all over each other.
    #[error(
        "the boxes around the labels fill the image {times:.0} times: these are grey values; segment the image first"
    )]
    Interleaved {
        /// Volume of the boxes over that of the image.
        times: f64,
    },
    /// The voxels of most labels are specks.
    #[error(
        "the voxels of {labels} labels are specks all over the image: these are grey values; segment the image first"
    )]
    Scattered {
        /// How many labels are.
        labels: usize,
    },
    /// All voxels are zero.
    #[error("all voxels are zero: the image has no label")]
    NoLabels,
    /// The label asked for is not there.
    #[error("no voxel has the label {label}; {}", listed(labels))]
    NoSuchLabel {
        /// The label asked for.
        label: i64,
        /// Those that are there, with their numbers of voxels.
        labels: BTreeMap<i64, usize>,
    },
    /// There are several labels.
    #[error(
        "the image has several grains, and one can be read: ask for one with --label, or fit all of them (grainform batch); {}",
        listed(labels)
    )]
    SeveralLabels {
        /// They, with their numbers of voxels.
        labels: BTreeMap<i64, usize>,
    },
    /// The border of the image cuts the label off.
    #[error(
        "the label {label} is cut off at the border of the volume, on which {:.0} % of its boundary lies: how large the \
         grain is cannot be known; scan it whole, or crop the volume with a margin",
        100.0 * share
    )]
    CutOff {
        /// The label.
        label: i64,
        /// Share of its boundary that lies on one side of the image.
        share: f64,
    },
    /// A label goes on beyond all sides of the image.
    #[error(
        "the label {label} goes on beyond all six sides of the volume, as what surrounds the grains does: give that the value 0, or \
         name grains by their labels (--label)"
    )]
    Background {
        /// The label.
        label: i64,
    },
    /// The border of the image cuts bodies of a label off, which has others.
    #[error(
        "of the label {label}, {} cut off at the border of the volume, so that the size cannot be known; scan the grains \
         whole, or crop the volume with a margin",
        match bodies {
            1 => "1 body is".into(),
            _ => format!("{bodies} bodies are"),
        }
    )]
    BodiesCutOff {
        /// The label.
        label: i64,
        /// Number of bodies that are cut off.
        bodies: usize,
    },
    /// A label has nothing but specks.
    #[error(
        "the label {label} is {specks} specks of less than {most} voxels each, too few for a shape: look whether it is \
         noise of the segmentation, or scan more finely"
    )]
    Specks {
        /// The label.
        label: i64,
        /// Bodies that hang together by faces.
        specks: usize,
        /// Voxels of a speck are fewer.
        most: usize,
    },
    /// So few voxels have no shape.
    #[error(
        "the label {label} has {}, too few for a shape: look whether it is a speck of the segmentation, or scan more \
         finely",
        plural(*voxels, "voxel")
    )]
    TooFew {
        /// The label.
        label: i64,
        /// Its voxels.
        voxels: usize,
    },
    /// The voxels enclose nothing.
    #[error("the voxels of the label enclose no volume")]
    NoBody,
}

/// `labels: 1 (20 voxels), 2 (1 voxel)`
fn listed(labels: &BTreeMap<i64, usize>) -> String {
    let mut text = String::from("labels: ");
    for (at, (label, voxels)) in labels.iter().take(MOST_LISTED).enumerate() {
        let comma = if at == 0 { "" } else { ", " };
        let _ = write!(text, "{comma}{label} ({})", plural(*voxels, "voxel"));
    }
    match labels.len().saturating_sub(MOST_LISTED) {
        0 => {}
        more => {
            let _ = write!(text, " and {more} more");
        }
    }
    text
}
