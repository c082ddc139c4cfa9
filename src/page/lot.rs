//! The part of a page about a folder of results.

use super::packed::Packed;
use crate::measure::mesh_properties;
use crate::model::{Surface, load_grain};
use nalgebra::Point3;
use rayon::prelude::*;
use serde::Serialize;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Cells along an edge of the cube of directions of small surfaces, of few grains and of many.
const RESOLUTIONS: [(usize, usize); 2] = [(200, 14), (1000, 8)];

/// Why a folder of results is not shown.
#[derive(Debug, Error)]
#[non_exhaustive]
pub(crate) enum LotError {
    /// There is no table.
    #[error("{} holds no results.csv; make one with grainform batch", folder.display())]
    NoTable {
        /// The folder.
        folder: PathBuf,
    },
    /// The table is none.
    #[error("cannot read {} as CSV: {source}", path.display())]
    Csv {
        /// The file.
        path: PathBuf,
        /// Why.
        source: csv::Error,
    },
}

/// What is known of the grains of a folder.
#[derive(Debug, Clone, Serialize)]
struct Truth {
    columns: Vec<String>,
    /// A row for each of the table, where the grain is known.
    rows: Vec<Option<Vec<String>>>,
}

/// What a page shows of a folder of results.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct LotPart {
    name: String,
    columns: Vec<String>,
    rows: Vec<Vec<String>>,
    truth: Option<Truth>,
    resolution: usize,
    /// The surface of each grain whose model is there, along its principal axes.
    surfaces: Vec<Option<Packed>>,
}

impl LotPart {
    /// Cells along an edge of the cube of directions of the surfaces.
    pub(super) fn resolution(&self) -> usize {
        self.resolution
    }

    /// Reads the table in a folder of results, and surfaces from the models in it, of a thousand grains at most. `truth`
    /// is a table whose first column names the files of scans, and whose others are called as those of results.
    ///
    /// # Errors
    /// [`LotError`] where there is no table.
    pub(crate) fn read(folder: &Path, truth: Option<&Path>) -> Result<Self, LotError> {
        let path = folder.join("results.csv");
        if !path.is_file() {
            return Err(LotError::NoTable {
                folder: folder.into(),
            });
        }
        let (columns, rows) = table(&path)?;
        let paths = columns.iter().position(|column| column == "path");
        let inputs: Vec<PathBuf> = rows
            .iter()
            .map(|row| {
                paths
                    .and_then(|at| row.get(at))
                    .map_or(PathBuf::new(), PathBuf::from)
            })
            .collect();
        let most = RESOLUTIONS.iter().find(|(most, _)| rows.len() <= *most);
        let (most, resolution) = *most.unwrap_or(&RESOLUTIONS[1]);
        let names = crate::batch::names(&inputs);
        let surface = |(at, name): (usize, &String)| {
            let model = folder.join("models").join(format!("{name}.json"));
            let grain = load_grain(&model).ok().filter(|_| at < most)?;
            // Its mesh is none over the directions that all surfaces share.
            if grain.hidden_share() > 0.0 {
                return None;
            }
            let mesh = grain.mesh(resolution);
            let solid = mesh_properties(&mesh).ok()?;
            let axes = solid.principal()?.axes;
            let seen = |vertex: &Point3<f64>| axes.tr_mul(&(vertex - solid.centroid));
            Some(Packed::vectors(mesh.vertices.iter().map(seen)))
        };
        Ok(Self {
            name: folder.display().to_string(),
            columns,
            truth: truth.map(|path| Truth::read(path, &inputs)).transpose()?,
            resolution,
            surfaces: names.par_iter().enumerate().map(surface).collect(),
            rows,
        })
    }
}

impl Truth {
    /// Reads what is known of some scans.
    fn read(path: &Path, inputs: &[PathBuf]) -> Result<Self, LotError> {
        let (columns, rows) = table(path)?;
        let of = |input: &PathBuf| {
            let is_of = |row: &&Vec<String>| {
                let name = row.first().map(Path::new).and_then(Path::file_name);
                name.is_some() && name == input.file_name()
            };
            rows.iter().find(is_of).cloned()
        };
        Ok(Self {
            rows: inputs.iter().map(of).collect(),
            columns,
        })
    }
}

/// The names of the columns of a table, and its rows.
fn table(path: &Path) -> Result<(Vec<String>, Vec<Vec<String>>), LotError> {
    let failed = |source| LotError::Csv {
        path: path.into(),
        source,
    };
    let texts = |record: &csv::StringRecord| record.iter().map(str::to_owned).collect();
    let mut reader = csv::Reader::from_path(path).map_err(failed)?;
    let columns = texts(reader.headers().map_err(failed)?);
    let records = reader
        .records()
        .map(|record| record.map(|record| texts(&record)));
    let rows: Result<_, _> = records.collect();
    Ok((columns, rows.map_err(failed)?))
}
