//! What CalculiX prints.

use std::io::{Error, Result};

/// Displacements of nodes and the forces on them that their supports exert, as in the tables printed.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Answer {
    pub(crate) displacements: Vec<[f64; 3]>,
    pub(crate) forces: Vec<[f64; 3]>,
}

impl Answer {
    /// Reads the two tables, of these nodes, numbered from 0, in this order.
    ///
    /// # Errors
    ///
    /// Where a table is not there, lacks a node or holds what is not a number.
    pub(crate) fn read(printed: &str, nodes: &[usize]) -> Result<Self> {
        Ok(Self {
            displacements: table(printed, "displacements", nodes)?,
            forces: table(printed, "forces", nodes)?,
        })
    }
}

fn table(printed: &str, heading: &str, nodes: &[usize]) -> Result<Vec<[f64; 3]>> {
    let lines = printed.lines().map(str::trim);
    let mut rows = lines
        .skip_while(|line| !line.starts_with(heading))
        .skip(1)
        .filter(|line| !line.is_empty());
    nodes
        .iter()
        .map(|node| {
            let cells = rows.next().unwrap_or_default().split_whitespace();
            let numbers: Vec<f64> = cells.filter_map(|cell| cell.parse().ok()).collect();
            match numbers[..] {
                [number, x, y, z] if number == (node + 1) as f64 => Ok([x, y, z]),
                _ => Err(Error::other(format!(
                    "ccx did not print the {heading} of node {}",
                    node + 1
                ))),
            }
        })
        .collect()
}
