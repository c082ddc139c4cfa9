//! Which points lie in a row, as one line of a scanner does.

use crate::fit::neighbours::Neighbours;
use crate::spread::{covariance, median, principal};
use nalgebra::Vector3;

/// Nearest points, the own one among them, that tell whether a point lies in a row; as many are the fewest that a row has.
const AROUND: usize = 9;

/// Of a row half of the points have neighbours that spread less across than by this share of their spread along. Of the outermost
/// rows of bodies it is .07 to .25, of 30 and more points of a surface .6 to .7.
const ACROSS: f64 = 0.3;

/// Whether points lie along a line, straight or not, and not all over a surface.
pub(super) fn is_row(places: &[Vector3<f64>]) -> bool {
    if places.len() < AROUND {
        return false;
    }
    let near = Neighbours::new(places);
    let across = |place: &Vector3<f64>| {
        let own = near.nearest(place, AROUND);
        let (_, spread) = covariance(own.iter().map(|&at| places[at]));
        let (variances, _) = principal(&spread)?;
        Some((variances[1].max(0.0) / variances[2]).sqrt())
    };
    let mut shares: Vec<f64> = places.iter().filter_map(across).collect();
    median(&mut shares).is_some_and(|share| share < ACROSS)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::Sampling;

    #[test]
    fn a_ring_is_a_row_and_a_ball_is_none() {
        let ring = |at: usize| {
            let (sin, cos) = (0.05 * at as f64).sin_cos();
            Vector3::new(cos, sin, 0.002 * (at % 3) as f64)
        };
        let ring: Vec<Vector3<f64>> = (0..125).map(ring).collect();
        assert!(is_row(&ring));
        assert!(!is_row(&ring[..AROUND - 1]));
        for count in [30, 300] {
            assert!(!is_row(&Sampling::Fibonacci.directions(count, 0).unwrap()));
        }
    }
}
