//! Beds that are finished, in a table that grows.

use super::shapes::Shape;
use serde::{Deserialize, Serialize};
use std::error::Error;
use std::fs::{File, OpenOptions};
use std::sync::{Mutex, PoisonError};

/// The figures of a bed.
#[derive(Clone, Serialize, Deserialize)]
pub(crate) struct Row {
    shape: String,
    friction: f64,
    grains: usize,
    seed: u64,
    pub(crate) packing: f64,
    pub(crate) neighbours: f64,
}

/// All that were finished before, and where others are added.
pub(crate) struct Kept {
    rows: Vec<Row>,
    table: Mutex<csv::Writer<File>>,
}

impl Row {
    pub(crate) fn is_of(&self, shape: &Shape) -> bool {
        self.shape == shape.name && self.friction == shape.friction
    }
}

impl Kept {
    pub(crate) fn open(path: &str) -> Result<Self, Box<dyn Error>> {
        let file = OpenOptions::new()
            .read(true)
            .append(true)
            .create(true)
            .open(path)?;
        let rows: Vec<Row> = csv::Reader::from_reader(&file)
            .deserialize()
            .collect::<Result<_, _>>()?;
        let table = csv::WriterBuilder::new()
            .has_headers(rows.is_empty())
            .from_writer(file);
        Ok(Self {
            rows,
            table: Mutex::new(table),
        })
    }

    /// What is known of a bed, or is found and added.
    pub(crate) fn row(
        &self,
        shape: &Shape,
        seed: u64,
        grains: usize,
        found: impl FnOnce() -> Result<[f64; 2], Box<dyn Error>>,
    ) -> Result<Row, Box<dyn Error>> {
        let is_same = |row: &&Row| row.is_of(shape) && row.seed == seed && row.grains == grains;
        if let Some(row) = self.rows.iter().find(is_same) {
            return Ok(row.clone());
        }
        let [packing, neighbours] = found()?;
        let row = Row {
            shape: shape.name.into(),
            friction: shape.friction,
            grains,
            seed,
            packing,
            neighbours,
        };
        let mut table = self.table.lock().unwrap_or_else(PoisonError::into_inner);
        table.serialize(&row)?;
        table.flush()?;
        Ok(row)
    }
}
