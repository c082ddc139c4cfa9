//! The part of a page about a folder of results.

use super::packed::Packed;
use crate::measure::mesh_properties;
use crate::model::{Surface, load_grain};
use nalgebra::Point3;
use rayon::prelude::*;
use serde::Serialize;
use std::collections::HashMap;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Cells along an edge of the cube of directions of small surfaces, of few grains and of many.
const RESOLUTIONS: [(usize, usize); 2] = [(200, 14), (1000, 8)];

/// Measures that an error names.
const MOST_NAMED: usize = 12;

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
    /// A table of truths tells nothing of the grains.
    #[error(
        "no scan of {} is named in the first column of {}: name there the files of the scans, such as {example}",
        folder.display(), truth.display()
    )]
    NoGrain {
        /// The folder of results.
        folder: PathBuf,
        /// The table.
        truth: PathBuf,
        /// The name of one of the scans.
        example: String,
    },
    /// A name in a table of truths is that of several grains.
    #[error(
        "which {name} of {} is meant is not clear: write the scans' paths into its first column, such as {example}",
        truth.display()
    )]
    Ambiguous {
        /// The table.
        truth: PathBuf,
        /// The name of the files.
        name: String,
        /// The path of one of the scans.
        example: String,
    },
    /// A table of truths tells nothing that was measured.
    #[error(
        "no column of {} is called as a measure in {}; call them as these are: {}",
        truth.display(), folder.display(), measures.join(", ")
    )]
    NoMeasure {
        /// The folder of results.
        folder: PathBuf,
        /// The table.
        truth: PathBuf,
        /// Names of measures.
        measures: Vec<String>,
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
    /// is a table whose first column names scans by their paths, or by their files where each name is there once, and whose
    /// others are called as those of results.
    ///
    /// # Errors
    /// [`LotError`] where there is no table, or where `truth` tells nothing of what it holds.
    pub(crate) fn read(folder: &Path, truth: Option<&Path>) -> Result<Self, LotError> {
        let path = folder.join("results.csv");
        if !path.is_file() {
            return Err(LotError::NoTable {
                folder: folder.into(),
            });
        }
        let (columns, rows) = table(&path)?;
        let at = columns.iter().position(|column| column == "path");
        let path = |row: &Vec<String>| at.and_then(|at| row.get(at)).cloned().unwrap_or_default();
        let paths: Vec<String> = rows.iter().map(path).collect();
        let most = RESOLUTIONS.iter().find(|(most, _)| rows.len() <= *most);
        let (most, resolution) = *most.unwrap_or(&RESOLUTIONS[1]);
        let names = crate::batch::names(&paths);
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
        let known = truth.map(|path| {
            let known = Truth::read(path, &paths)?;
            known.check(path, folder, &paths, &columns)?;
            Ok(known)
        });
        Ok(Self {
            name: folder.display().to_string(),
            truth: known.transpose()?,
            columns,
            resolution,
            surfaces: names.par_iter().enumerate().map(surface).collect(),
            rows,
        })
    }
}

impl Truth {
    /// Reads what is known of some scans.
    fn read(path: &Path, paths: &[String]) -> Result<Self, LotError> {
        let (columns, rows) = table(path)?;
        let known = rows.iter().filter_map(|row| Some((row.first()?, row)));
        let by_path: HashMap<&String, &Vec<String>> = known.clone().collect();
        let mut by_name: HashMap<&OsStr, Vec<&Vec<String>>> = HashMap::new();
        for (text, row) in known {
            by_name.entry(file_name(text)).or_default().push(row);
        }
        let mut scans: HashMap<&OsStr, usize> = HashMap::new();
        for input in paths {
            *scans.entry(file_name(input)).or_default() += 1;
        }
        let of = |input: &String| {
            if let Some(row) = by_path.get(input) {
                return Ok(Some((*row).clone()));
            }
            let name = file_name(input);
            match by_name.get(name).map(Vec::as_slice) {
                None => Ok(None),
                Some([row]) if scans[name] == 1 => Ok(Some((*row).clone())),
                Some(_) => Err(LotError::Ambiguous {
                    truth: path.into(),
                    name: name.to_string_lossy().into_owned(),
                    example: input.clone(),
                }),
            }
        };
        Ok(Self {
            rows: paths.iter().map(of).collect::<Result<_, _>>()?,
            columns,
        })
    }

    /// Whether it tells anything of grains and of measures of them.
    fn check(
        &self,
        truth: &Path,
        folder: &Path,
        paths: &[String],
        columns: &[String],
    ) -> Result<(), LotError> {
        let (truth, folder) = (truth.to_path_buf(), folder.to_path_buf());
        let measures = crate::batch::measures(columns);
        if !self.columns.iter().any(|own| measures.contains(own)) {
            let measures = measures.into_iter().take(MOST_NAMED).collect();
            return Err(LotError::NoMeasure {
                folder,
                truth,
                measures,
            });
        }
        if self.rows.iter().all(Option::is_none) {
            let name = paths.first().map(Path::new).and_then(Path::file_name);
            let example = name.unwrap_or_default().to_string_lossy().into_owned();
            return Err(LotError::NoGrain {
                folder,
                truth,
                example,
            });
        }
        Ok(())
    }
}

fn file_name(path: &str) -> &OsStr {
    Path::new(path).file_name().unwrap_or_default()
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
