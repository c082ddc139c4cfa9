//! Bins of directions, found without angles.

use crate::sphere::{cube_place, part};
use nalgebra::Vector3;

/// Bins along an edge of the cube: 1.9 degrees apart.
const PER_EDGE: usize = 48;

/// Number of all bins.
pub(super) const BINS: usize = 6 * PER_EDGE * PER_EDGE;

/// The bin of a direction of any length: face of the cube, row, column.
pub(super) fn bin(d: &Vector3<f64>) -> usize {
    let (face, place) = cube_place(d);
    let [row, column] = place.map(|tangent| part(tangent, PER_EDGE));
    (face * PER_EDGE + row) * PER_EDGE + column
}
