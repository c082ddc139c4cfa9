//! What neighbours on the sphere tell of a value in a direction where values slope.

use nalgebra::{DMatrix, DVector, Vector3};

/// Neighbours that tell a slope, at least.
const LEAST: usize = 3;

/// Those nearer than this share of the farthest one's distance count no more than one there.
const NEAREST: f64 = 1e-3;

/// Neighbours in a row tell no slope across it: singular values below this share of the largest are none.
const RANK: f64 = 1e-3;

const MOST_SWEEPS: usize = 100;

/// The value in a direction n if it is c.n with a constant vector c, as 1 / r is on a plane, by those of its neighbours: least
/// squares, in which the nearer ones count more. `None` of fewer than three.
pub(in crate::fit) fn on_slope(n: &Vector3<f64>, near: &[(Vector3<f64>, f64)]) -> Option<f64> {
    let distances = near.iter().map(|(other, _)| (other - n).norm());
    let farthest = distances.clone().fold(0.0, f64::max);
    if near.len() < LEAST || farthest == 0.0 {
        return None;
    }
    let weights: Vec<f64> = distances
        .map(|distance| farthest / distance.max(NEAREST * farthest))
        .collect();
    let rows = DMatrix::from_fn(near.len(), 3, |i, axis| weights[i] * near[i].0[axis]);
    let values = DVector::from_fn(near.len(), |i, _| weights[i] * near[i].1);
    let svd = rows.try_svd(true, true, f64::EPSILON, MOST_SWEEPS)?;
    let limit = RANK * svd.singular_values.max();
    let slope = svd.solve(&values, limit).ok()?;
    let value = slope.fixed_rows::<3>(0).dot(n);
    value.is_finite().then_some(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A plane seen at a slant, and one of its points.
    #[test]
    fn it_is_exact_on_a_plane_and_near_it_where_neighbours_stand_in_a_row() {
        let normal = Vector3::new(0.3, -0.8, 0.5);
        let inverse = |n: &Vector3<f64>| normal.dot(n) / 0.7;
        let n = Vector3::new(0.1, -0.9, 0.4).normalize();
        let about = |x: f64, y: f64| {
            let other = (n + Vector3::new(x, 0.0, y)).normalize();
            (other, inverse(&other))
        };
        let ring = [
            about(0.1, 0.0),
            about(-0.2, 0.1),
            about(0.05, 0.2),
            about(-0.1, -0.05),
        ];
        let value = on_slope(&n, &ring).unwrap();
        assert!((value - inverse(&n)).abs() < 1e-12);
        assert_eq!(on_slope(&n, &ring[..2]), None);
        let row = [about(0.1, 0.0), about(0.2, 0.0), about(-0.1, 0.0)];
        let value = on_slope(&n, &row).unwrap();
        assert!(
            (value - inverse(&n)).abs() < 0.02,
            "{value} {}",
            inverse(&n)
        );
    }

    #[test]
    fn the_nearer_neighbours_count_more() {
        let n = Vector3::z();
        let about = |x: f64, y: f64, value: f64| (Vector3::new(x, y, 1.0).normalize(), value);
        let near = [
            about(0.01, 0.01, 1.0),
            about(-0.01, 0.01, 1.0),
            about(0.0, -0.01, 1.0),
        ];
        let far = [
            about(0.3, 0.0, 2.0),
            about(-0.3, 0.0, 2.0),
            about(0.0, 0.3, 2.0),
        ];
        let value = on_slope(&n, &[near, far].concat()).unwrap();
        assert!((value - 1.0).abs() < 0.02, "{value}");
    }
}
