//! What the faces of a scan enclose.

use crate::digits::plural;
use crate::measure::{Fill, ScannedBody, spikes};
use crate::report::labels::Labels;
use crate::report::number::short;
use serde::Serialize;
use std::fmt;

/// The bodies that the faces of a scan enclose.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct FacesRecord {
    /// Bodies that share no point; of an open mesh, its parts.
    pub bodies: usize,
    /// Hollows, which are no part of the volume and whose surface is part of the area.
    pub cavities: usize,
    /// What closes small holes; `null` where there were none, or larger ones.
    pub filled: Option<FillRecord>,
    /// Vertices that stand far out of those round them, or far in.
    pub spikes: usize,
}

/// What closes small holes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct FillRecord {
    /// Number of holes.
    pub holes: usize,
    /// Edges of their rims.
    pub edges: usize,
    /// Area of the triangles that close them: part of the area.
    pub area: f64,
}

impl FacesRecord {
    pub(super) fn new(scanned: &ScannedBody) -> Self {
        let record = |fill: Fill| FillRecord {
            holes: fill.holes,
            edges: fill.edges,
            area: fill.area,
        };
        Self {
            bodies: scanned.bodies,
            cavities: scanned.cavities,
            filled: scanned.fill.map(record),
            spikes: spikes(&scanned.mesh),
        }
    }

    /// What a reader of the figures must know, in whole sentences; of sums over bodies and inner surfaces only where
    /// these are told.
    pub(super) fn sentences(&self, labels: Labels, sums_are_told: bool) -> Vec<String> {
        let filled = self.filled.map(|filled| {
            format!(
                "Small holes were closed: {} with {}; the area holds {}{} for their fill, and lengths, volume \
                 and moments are those of the body that it closes, which may be less than the grain.",
                filled.holes,
                plural(filled.edges, "edge"),
                short(filled.area),
                labels.area()
            )
        });
        let several = (sums_are_told && self.bodies > 1).then(|| {
            format!(
                "Area, volume, centroid and moments are those of all {} bodies together.",
                self.bodies
            )
        });
        let hollow = (sums_are_told && self.cavities > 0).then(|| {
            format!(
                "The scan has {} (of hollows), whose volume is subtracted and whose area is part of the area.",
                plural(self.cavities, "inner surface")
            )
        });
        let spiky = (self.spikes > 0).then(|| {
            format!(
                "{} far out of the faces round {}, or far in, as spikes do: lengths and area are those of the spikes. \
                 Fit the scan, which leaves them out, and measure the model.",
                match self.spikes {
                    1 => "1 point stands".into(),
                    spikes => format!("{spikes} points stand"),
                },
                if self.spikes == 1 { "it" } else { "them" },
            )
        });
        [filled, several, hollow, spiky]
            .into_iter()
            .flatten()
            .collect()
    }
}

impl fmt::Display for FacesRecord {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.bodies)?;
        if self.cavities > 0 {
            write!(f, ", inner surfaces {}", self.cavities)?;
        }
        if let Some(filled) = self.filled {
            write!(
                f,
                ", holes closed {} of area {}",
                filled.holes,
                short(filled.area)
            )?;
        }
        Ok(())
    }
}
