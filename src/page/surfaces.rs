//! Small surfaces of the grains of a folder of results, from their models, or why there are none.

use super::packed::Packed;
use crate::batch::{RowKey, SavedModels, model, names};
use crate::digits::plural;
use crate::measure::mesh_properties;
use crate::model::{Surface, grain_from_json};
use nalgebra::Point3;
use rayon::prelude::*;
use serde::{Serialize, Serializer};
use std::fmt;
use std::path::Path;

/// Cells along an edge of the cube of directions of small surfaces, of few grains and of many.
const RESOLUTIONS: [(usize, usize); 2] = [(200, 14), (MOST, 8)];

/// The most surfaces of a page.
const MOST: usize = 1000;

/// Why a page has no surface of a grain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum NoSurface {
    /// No model is there.
    NoModel,
    /// A model is there, and is not known to be of this grain.
    OfAnother,
    /// A model is there, and the page has as many surfaces as it can have.
    TooMany,
    /// The model has no surface that encloses a volume.
    NoBody,
}

impl fmt::Display for NoSurface {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoModel => write!(
                f,
                "There is no model of this grain: batch --models saves those of scans that have a result."
            ),
            Self::OfAnother => write!(
                f,
                "The model that is called so is not shown: journal.jsonl does not tell that it was saved with this row. \
                 The same batch with --models saves the right one."
            ),
            Self::TooMany => write!(
                f,
                "The page has the surfaces of the first {MOST} scans alone: a report of the model itself shows it."
            ),
            Self::NoBody => write!(f, "The surface of its model encloses no volume."),
        }
    }
}

impl Serialize for NoSurface {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// The surfaces of the grains of a folder.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Surfaces {
    /// Cells along an edge of the cube of directions of each.
    pub(super) resolution: usize,
    /// That of each grain, along its principal axes.
    surfaces: Vec<Option<Packed>>,
    /// Why there is none.
    no_surface: Vec<Option<NoSurface>>,
}

impl Surfaces {
    /// Reads the models of these rows in a folder of results.
    pub(super) fn read(folder: &Path, rows: &[RowKey], saved: &SavedModels) -> Self {
        let few = RESOLUTIONS.iter().find(|(most, _)| rows.len() <= *most);
        let (_, resolution) = *few.unwrap_or(&RESOLUTIONS[1]);
        let paths: Vec<String> = rows.iter().map(|row| row.path.to_owned()).collect();
        let names = names(&paths);
        let surface = |(at, name): (usize, &String)| {
            let path = model(folder, name);
            if !path.is_file() {
                return Err(NoSurface::NoModel);
            }
            if at >= MOST {
                return Err(NoSurface::TooMany);
            }
            let bytes = std::fs::read(path).unwrap_or_default();
            match saved.has(&bytes, &rows[at]) {
                true => small(&bytes, resolution).ok_or(NoSurface::NoBody),
                false => Err(NoSurface::OfAnother),
            }
        };
        let found: Vec<Result<Packed, NoSurface>> =
            names.par_iter().enumerate().map(surface).collect();
        Self {
            resolution,
            no_surface: found
                .iter()
                .map(|found| found.as_ref().err().copied())
                .collect(),
            surfaces: found.into_iter().map(Result::ok).collect(),
        }
    }

    /// What models are there and not shown, as sentences.
    pub(super) fn doubts(&self, folder: &Path) -> Vec<String> {
        let folder = folder.display();
        let count = |reason| {
            let left_out = self.no_surface.iter().flatten();
            left_out.filter(|found| **found == reason).count()
        };
        let of_others = match count(NoSurface::OfAnother) {
            0 => None,
            models => Some(format!(
                "{} of {folder} {} not shown, for journal.jsonl tells of no row that was saved with {}: the same batch with \
                 --models saves the right ones.",
                plural(models, "model"),
                if models == 1 { "is" } else { "are" },
                if models == 1 { "it" } else { "them" }
            )),
        };
        let too_many = match count(NoSurface::TooMany) {
            0 => None,
            models => Some(format!(
                "The page has the surfaces of the first {MOST} scans of {folder} alone, and models of {models} more are \
                 there: report these themselves, or a batch of fewer scans."
            )),
        };
        of_others.into_iter().chain(too_many).collect()
    }
}

/// The surface of the model in the bytes of a file, along its principal axes.
fn small(bytes: &[u8], resolution: usize) -> Option<Packed> {
    let grain = grain_from_json(&String::from_utf8_lossy(bytes)).ok()?;
    let mesh = grain.mesh(resolution);
    let solid = mesh_properties(&mesh).ok()?;
    let axes = solid.principal()?.axes;
    let seen = |vertex: &Point3<f64>| axes.tr_mul(&(vertex - solid.centroid));
    Some(Packed::vectors(mesh.vertices.iter().map(seen)))
}
