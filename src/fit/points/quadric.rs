//! Heights over the smooth surface through neighbours.

use nalgebra::{Const, DVector, Dyn, OMatrix};

/// Numbers of a polynomial of second degree.
pub(in crate::fit) const NUMBERS: usize = 6;

/// What the polynomial of second degree in x and y that is nearest leaves of heights: `places` are x, y and height, x and y of
/// about size one.
pub(in crate::fit) fn off_quadric(places: &[[f64; 3]]) -> DVector<f64> {
    let row = |&[x, y, _]: &[f64; 3]| [1.0, x, y, x * x, x * y, y * y];
    let rows: Vec<f64> = places.iter().flat_map(row).collect();
    let matrix = OMatrix::<f64, Dyn, Const<NUMBERS>>::from_row_slice(&rows);
    let heights = DVector::from_iterator(places.len(), places.iter().map(|place| place[2]));
    let basis = matrix.qr().q();
    &heights - &basis * basis.tr_mul(&heights)
}
