//! The highest direction near by, of heights that need not be smooth.

use super::tangents::across;
use nalgebra::Vector3;
use std::f64::consts::FRAC_PI_4;

/// Most steps; some sixty are usual.
const MAX_STEPS: usize = 200;

/// Climbs from the unit vector `n` by steps (in radians) in eight tangential directions, halved where none leads up,
/// until they are shorter than `least`. Gives the direction and its height.
pub(crate) fn compass(
    mut n: Vector3<f64>,
    mut step: f64,
    least: f64,
    height: impl Fn(&Vector3<f64>) -> f64,
) -> (Vector3<f64>, f64) {
    let mut highest = height(&n);
    for _ in 0..MAX_STEPS {
        if step < least {
            break;
        }
        let [first, second] = across(&n);
        let best = (0..8)
            .map(|i| {
                let (sin, cos) = (i as f64 * FRAC_PI_4).sin_cos();
                let next = (n + (first * cos + second * sin) * step).normalize();
                (next, height(&next))
            })
            .max_by(|one, other| one.1.total_cmp(&other.1));
        match best {
            Some((next, height)) if height > highest => (n, highest) = (next, height),
            _ => step *= 0.5,
        }
    }
    (n, highest)
}
