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
    /// Those of a quarter of a cell's samples, with the values of bases of each cell's degree.
    pub(super) fn new(
        cover: &Cover,
        quarter: usize,
        samples: &Samples,
        degrees: &[usize],
        bases: &[CapBasis],
    ) -> Self {
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
        let cells: Vec<u16> = order.iter().map(|&at| cells[at]).collect();
        let directions: Vec<[f64; 4]> = numbers
            .iter()
            .map(|&i| samples.directions[i])
            .map(|n| [n.x, n.y, n.z, 0.0])
            .collect();
        Self {
            weights: numbers.iter().map(|&i| samples.weights[i]).collect(),
            radii: numbers.iter().map(|&i| samples.radii[i]).collect(),
            shares: order
                .iter()
                .flat_map(|&at| &shares[at * rows..(at + 1) * rows])
                .copied()
                .collect(),
            values: values(cover, &cells, &directions, degrees, bases),
            cells,
        }
    }
}

/// Values of the bases of some cells in some directions.
fn values(
    cover: &Cover,
    cells: &[u16],
    directions: &[[f64; 4]],
    degrees: &[usize],
    bases: &[CapBasis],
) -> Vec<f64> {
    let rows = directions.len();
    let degree = |&cell: &u16| degrees[usize::from(cell)];
    let columns: usize = cells
        .iter()
        .map(|cell| coefficient_count(degree(cell)))
        .sum();
    let mut values = vec![0.0; columns * rows];
    let (mut places, mut start) = (Places::default(), 0);
    for cell in cells {
        cover
            .cap(usize::from(*cell))
            .locate(directions, &mut places);
        bases[degree(cell)].evaluate(&places, &mut values[start * rows..], rows);
        start += coefficient_count(degree(cell));
    }
    values
}
