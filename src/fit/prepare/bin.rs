//! Bins of directions, found without angles.

use nalgebra::Vector3;

/// Bins along an edge of the cube: 1.9 degrees apart.
const PER_EDGE: usize = 48;

/// Number of all bins.
pub(super) const BINS: usize = 6 * PER_EDGE * PER_EDGE;

/// The bin of a direction of any length: face of the cube, row, column.
pub(super) fn bin(d: &Vector3<f64>) -> usize {
    let axis = d.iamax();
    let face = 2 * axis + usize::from(d[axis] < 0.0);
    let place = |t: f64| {
        let unit = 0.5 * (t / d[axis].abs() + 1.0);
        ((unit * PER_EDGE as f64) as usize).min(PER_EDGE - 1)
    };
    (face * PER_EDGE + place(d[(axis + 1) % 3])) * PER_EDGE + place(d[(axis + 2) % 3])
}
