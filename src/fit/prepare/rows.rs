//! Which points lie in a row, as one line of a scanner does.

use crate::fit::points::neighbours::Neighbours;
use crate::spread::{covariance, principal, upper_median};
use nalgebra::Vector3;

/// Nearest points, the own one among them, that tell whether a point lies in a row; as many are the fewest that a row has.
const AROUND: usize = 9;

/// Of a row half of the points have neighbours that spread less across than by this share of their spread along. Of the outermost
/// rows of bodies it is .07 to .25, of 30 and more points of a surface .6 to .7.
const ACROSS: f64 = 0.3;

/// Whether points lie along a line that bends round, and not all over a surface, nor straight on.
pub(super) fn is_row(places: &[Vector3<f64>]) -> bool {
    if places.len() < AROUND || across(places).is_none_or(|share| share < ACROSS) {
        return false;
    }
    let near = Neighbours::new(places);
    let around = |place: &Vector3<f64>| {
        let own = near.nearest(place, AROUND).into_iter();
        across(&own.map(|at| places[at]).collect::<Vec<_>>())
    };
    let mut shares: Vec<f64> = places.iter().filter_map(around).collect();
    upper_median(&mut shares).is_some_and(|share| share < ACROSS)
}

/// How much less points spread across the line along which they spread most.
fn across(places: &[Vector3<f64>]) -> Option<f64> {
    let (_, spread) = covariance(places.iter().copied());
    let (variances, _) = principal(&spread)?;
    Some((variances[1].max(0.0) / variances[2]).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::Sampling;

    #[test]
    fn a_ring_is_a_row_and_a_needle_and_a_ball_are_none() {
        let ring = |at: usize| {
            let (sin, cos) = (0.05 * at as f64).sin_cos();
            Vector3::new(cos, sin, 0.002 * (at % 3) as f64)
        };
        let ring: Vec<Vector3<f64>> = (0..125).map(ring).collect();
        assert!(is_row(&ring));
        assert!(!is_row(&ring[..AROUND - 1]));
        let needle = |at: usize| Vector3::new(0.1 * at as f64, 0.002 * (at % 3) as f64, 0.0);
        assert!(!is_row(&(0..125).map(needle).collect::<Vec<_>>()));
        for count in [30, 300] {
            assert!(!is_row(&Sampling::Fibonacci.directions(count, 0).unwrap()));
        }
    }
}
