//! Cells in a model's file.

use crate::sphere::{Cover, CoverError, CubeCell, MARGIN};
use serde::{Deserialize, Serialize};

/// A cell, numbered as in [`CubeCell`], and the coefficients of its cap basis by degree.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CellRecord {
    face: u8,
    parts: u16,
    row: u16,
    column: u16,
    coefficients: Vec<f64>,
}

/// The records of cells, and their margin where it is not the usual one.
pub(super) fn of_cover(
    cover: &Cover,
    coefficients: &[Vec<f64>],
) -> (Option<Vec<CellRecord>>, Option<f64>) {
    let cells = cover.cells().iter().zip(coefficients);
    let record = |(cell, coefficients): (&CubeCell, &Vec<f64>)| CellRecord {
        face: cell.face,
        parts: cell.parts,
        row: cell.row,
        column: cell.column,
        coefficients: coefficients.clone(),
    };
    let margin = cover.margin();
    (
        Some(cells.map(record).collect()),
        (margin != MARGIN).then_some(margin),
    )
}

/// The cover of records of cells, and the coefficients of each.
pub(super) fn to_cover(
    cells: Vec<CellRecord>,
    margin: Option<f64>,
) -> Result<(Cover, Vec<Vec<f64>>), CoverError> {
    let place = |record: CellRecord| {
        let cell = CubeCell {
            face: record.face,
            parts: record.parts,
            row: record.row,
            column: record.column,
        };
        (cell, record.coefficients)
    };
    let (cells, coefficients) = cells.into_iter().map(place).unzip();
    let cover = Cover::with_margin(cells, margin.unwrap_or(MARGIN))?;
    Ok((cover, coefficients))
}
