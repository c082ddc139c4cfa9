//! What the segments between two polar angles share: they differ by a turn about the pole only, so
//! the basis has the same values at the same places in all of them.

use crate::sphere::{AngularPartition, CapBasis, GaussLegendre, Places, coefficient_count};
use crate::vectorize::vectorize;
use std::f64::consts::{PI, TAU};

/// Corners, middles of the borders and middle of a segment: 3 x 3 places, row by row.
pub(crate) const LATTICE: usize = 9;

/// Nodes evaluated together; rules are filled up to a multiple with nodes of no weight.
const LANES: usize = 8;

/// Tables of one row of a partition. Matrices are column-major: one column per function.
pub(crate) struct Row {
    /// The basis at the lattice.
    pub(crate) lattice: Vec<f64>,
    /// Weights, in solid angle, of the nodes of a product Gauss rule for area and volume: good to
    /// 1e-6 or better, enough to compare with a reference surface that is itself off by 1e-4 to
    /// 1e-2.
    weights: Vec<f64>,
    /// The basis at the nodes, and the three components of its surface gradient.
    nodes: [Vec<f64>; 4],
}

/// Nodes along a side beside those that the volume asks for: area is a root, and of steep expansions it takes more.
const MARGIN: usize = 12;

/// The rows of a partition, from north to south, for expansions in `basis`.
pub(crate) fn rows(partition: AngularPartition, basis: &CapBasis) -> Vec<Row> {
    let k = partition.per_angle();
    // r^3 sin(theta) is a trigonometric polynomial of degree 3L + 1; n nodes on an interval of
    // width h integrate degree d to rounding once n is well above d h / 4.
    let [polar, azimuthal] = [PI, TAU].map(|whole| {
        let width = whole / k as f64;
        let degree = (3 * basis.degree() + 1) as f64;
        GaussLegendre::new(MARGIN + (degree * width / 4.0).ceil() as usize)
    });
    (0..k)
        .map(|row| {
            let rectangle = partition.rectangle(row * k);
            let cap = rectangle.cap();
            let (mut directions, mut weights): (Vec<_>, Vec<_>) = rectangle
                .nodes(&polar, &azimuthal)
                .into_iter()
                .map(|(n, weight)| ([n.x, n.y, n.z, 0.0], weight))
                .unzip();
            let whole = directions.len().next_multiple_of(LANES);
            directions.resize(whole, directions[0]);
            weights.resize(whole, 0.0);
            let mut places = Places::default();
            cap.locate(&rectangle.lattice(), &mut places);
            let lattice = basis_at(basis, &places);
            cap.locate(&directions, &mut places);
            let [x, y, z] = basis.evaluate_gradients(&cap, &places);
            Row {
                lattice,
                weights,
                nodes: [basis_at(basis, &places), x, y, z],
            }
        })
        .collect()
}

fn basis_at(basis: &CapBasis, places: &Places) -> Vec<f64> {
    let mut values = vec![0.0; coefficient_count(basis.degree()) * places.len()];
    basis.evaluate(places, &mut values, places.len());
    values
}

impl Row {
    /// Area and volume below an expansion over a segment of this row.
    pub(crate) fn area_and_volume(&self, coefficients: &[f64]) -> [f64; 2] {
        let stride = self.weights.len();
        let (mut area, mut volume) = ([0.0; LANES], [0.0; LANES]);
        vectorize(
            #[inline(always)]
            || {
                for (block, weights) in self.weights.chunks_exact(LANES).enumerate() {
                    let [r, gx, gy, gz] = {
                        let mut sums = [[0.0; LANES]; 4];
                        for (column, coefficient) in coefficients.iter().enumerate() {
                            let at = column * stride + block * LANES;
                            for (sum, matrix) in sums.iter_mut().zip(&self.nodes) {
                                let values = &matrix[at..at + LANES];
                                for i in 0..LANES {
                                    sum[i] += coefficient * values[i];
                                }
                            }
                        }
                        sums
                    };
                    for i in 0..LANES {
                        let slope_squared = gx[i] * gx[i] + gy[i] * gy[i] + gz[i] * gz[i];
                        let squared = r[i] * r[i];
                        area[i] += weights[i] * (squared * (squared + slope_squared)).sqrt();
                        volume[i] += weights[i] * squared * r[i] / 3.0;
                    }
                }
            },
        );
        [area.iter().sum(), volume.iter().sum()]
    }

    /// Radius of an expansion at the lattice of a segment of this row.
    pub(crate) fn lattice_radii(&self, coefficients: &[f64]) -> [f64; LATTICE] {
        let mut radii = [0.0; LATTICE];
        for (column, coefficient) in self.lattice.chunks(LATTICE).zip(coefficients) {
            for (radius, value) in radii.iter_mut().zip(column) {
                *radius += coefficient * value;
            }
        }
        radii
    }
}
