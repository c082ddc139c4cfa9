//! Samples that the same few cells have a share in.

use super::nodes::Samples;
use crate::sphere::{CapBasis, Cover, Places, coefficient_count};

/// The samples of a quarter of a cell: they touch the same few cells.
pub(super) struct Patch {
    /// The cells they touch.
    pub(super) cells: Vec<u16>,
    pub(super) weights: Vec<f64>,
    pub(super) radii: Vec<f64>,
    /// Share of each cell in the surface at each sample: one column per cell.
    pub(super) shares: Vec<f64>,
    /// Values of the bases at the samples: columns by cell and degree.
    pub(super) values: Vec<f64>,
}

impl Patch {
    /// Those of a quarter of a cell's samples; the directions stand in the place of the values.
    pub(super) fn new(cover: &Cover, quarter: usize, samples: &Samples) -> Self {
        let (side, half) = (samples.side, samples.side / 2);
        let [first_row, first_column] = [quarter / 2 * half, quarter % 2 * half];
        let numbers: Vec<usize> = (0..half * half)
            .map(|i| (first_row + i / half) * side + first_column + i % half)
            .collect();
        let rows = numbers.len();
        let (mut cells, mut shares): (Vec<u16>, Vec<f64>) = (Vec::new(), Vec::new());
        let mut touched = Vec::new();
        for (row, &number) in numbers.iter().enumerate() {
            cover.shares(&samples.directions[number], &mut touched);
            for &(cell, share) in &touched {
                let at = cells
                    .iter()
                    .position(|&own| own == cell)
                    .unwrap_or_else(|| {
                        cells.push(cell);
                        shares.resize(cells.len() * rows, 0.0);
                        cells.len() - 1
                    });
                shares[at * rows + row] = share;
            }
        }
        let mut order: Vec<usize> = (0..cells.len()).collect();
        order.sort_unstable_by_key(|&at| cells[at]);
        Self {
            cells: order.iter().map(|&at| cells[at]).collect(),
            weights: numbers.iter().map(|&i| samples.weights[i]).collect(),
            radii: numbers.iter().map(|&i| samples.radii[i]).collect(),
            shares: order
                .iter()
                .flat_map(|&at| &shares[at * rows..(at + 1) * rows])
                .copied()
                .collect(),
            values: numbers
                .iter()
                .flat_map(|&i| samples.directions[i].iter().copied())
                .collect(),
        }
    }

    /// Evaluates the bases at the samples.
    pub(super) fn evaluate(&mut self, cover: &Cover, degrees: &[usize], bases: &[CapBasis]) {
        let rows = self.weights.len();
        let directions: Vec<[f64; 4]> = self
            .values
            .chunks_exact(3)
            .map(|n| [n[0], n[1], n[2], 0.0])
            .collect();
        let degree = |&cell: &u16| degrees[usize::from(cell)];
        let columns: usize = self
            .cells
            .iter()
            .map(|c| coefficient_count(degree(c)))
            .sum();
        self.values.resize(columns * rows, 0.0);
        let (mut places, mut start) = (Places::default(), 0);
        for cell in &self.cells {
            cover
                .cap(usize::from(*cell))
                .locate(&directions, &mut places);
            bases[degree(cell)].evaluate(&places, &mut self.values[start * rows..], rows);
            start += coefficient_count(degree(cell));
        }
    }
}
