//! Steps that are shortened until they gain something.

use nalgebra::Vector3;

/// Shares of a step that are tried, one after the other.
const SHARES: [f64; 5] = [1.0, 0.5, 0.25, 0.1, 0.01];

/// The direction after a step from one, or after the largest share of it that gains something, and what that is.
pub(super) fn shortened<T>(
    from: &Vector3<f64>,
    step: &Vector3<f64>,
    gains: impl Fn(&Vector3<f64>) -> Option<T>,
) -> Option<(Vector3<f64>, T)> {
    SHARES.into_iter().find_map(|share| {
        let next = (from + step * share).try_normalize(0.0)?;
        gains(&next).map(|gained| (next, gained))
    })
}
