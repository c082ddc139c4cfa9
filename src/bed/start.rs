//! Where grains are before they fall: on a grid above the floor, apart from each other, each turned at random.

use super::body::Body;
use super::grain::GrainKind;
use super::settings::{BedError, BedSettings, Container};
use nalgebra::{Point3, Quaternion, UnitQuaternion, Vector3};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal, StandardUniform};

/// How much wider than the widest grain a place of the grid is.
const ROOM: f64 = 1.02;

/// Most places along a side of the grid: in wide containers grains begin farther apart.
const MOST_ALONG: f64 = 2000.0;

/// Sideways velocity at the start, as a share of sqrt(g d).
const SIDEWAYS: f64 = 0.5;

/// The grains of a bed before they fall, from a height above the floor on; `shares` says how many are of each kind.
pub(super) fn loose_column(
    settings: &BedSettings,
    kinds: &[GrainKind],
    shares: &[f64],
    floor: f64,
) -> Result<Vec<Body>, BedError> {
    if kinds.len() != shares.len() {
        return Err(BedError::Shares {
            kinds: kinds.len(),
            shares: shares.len(),
        });
    }
    let mut random = ChaCha8Rng::seed_from_u64(settings.seed);
    let order = in_any_order(counts(settings.grains, shares)?, &mut random);
    let reach = kinds.iter().map(|kind| kind.reach).fold(0.0, f64::max);
    let places = level(settings.container, reach);
    if places.is_empty() {
        let widest = 2.0 * reach;
        return Err(BedError::Narrow { widest });
    }
    let bodies = order.into_iter().enumerate().map(|(number, kind)| {
        let [x, y] = places[number % places.len()];
        let z = floor + reach * (1.0 + 2.0 * ROOM * (number / places.len()) as f64);
        let pace = SIDEWAYS * (settings.gravity * 2.0 * kinds[kind].radius).sqrt();
        let mut sideways = || -> f64 {
            let lot: f64 = StandardUniform.sample(&mut random);
            pace * (2.0 * lot - 1.0)
        };
        let velocity = Vector3::new(sideways(), sideways(), 0.0);
        let [w, i, j, k]: [f64; 4] = std::array::from_fn(|_| StandardNormal.sample(&mut random));
        Body {
            kind,
            position: Point3::new(x, y, z),
            velocity,
            orientation: UnitQuaternion::new_normalize(Quaternion::new(w, i, j, k)),
            momentum: Vector3::zeros(),
        }
    });
    Ok(bodies.collect())
}

/// So many grains of each kind, by the largest remainders.
fn counts(grains: usize, shares: &[f64]) -> Result<Vec<usize>, BedError> {
    let sum: f64 = shares.iter().sum();
    // Written so that NaN fails.
    if !(sum > 0.0 && sum.is_finite() && shares.iter().all(|share| *share >= 0.0)) {
        return Err(BedError::NoKinds);
    }
    let ideal = shares.iter().map(|share| share / sum * grains as f64);
    let ideal: Vec<f64> = ideal.collect();
    let mut counts: Vec<usize> = ideal.iter().map(|count| count.floor() as usize).collect();
    let mut by_remainder: Vec<usize> = (0..shares.len()).collect();
    let remainder = |kind: &usize| ideal[*kind] - ideal[*kind].floor();
    by_remainder.sort_by(|a, b| remainder(b).total_cmp(&remainder(a)));
    let missing = grains - counts.iter().sum::<usize>().min(grains);
    for kind in by_remainder.into_iter().cycle().take(missing) {
        counts[kind] += 1;
    }
    Ok(counts)
}

/// The kinds of all grains, shuffled.
fn in_any_order(counts: Vec<usize>, random: &mut ChaCha8Rng) -> Vec<usize> {
    let kinds = counts.into_iter().enumerate();
    let kinds = kinds.flat_map(|(kind, count)| std::iter::repeat_n(kind, count));
    let mut lots: Vec<(f64, usize)> = kinds
        .map(|kind| (StandardUniform.sample(&mut *random), kind))
        .collect();
    lots.sort_by(|(one, _), (other, _)| one.total_cmp(other));
    lots.into_iter().map(|(_, kind)| kind).collect()
}

/// The places of one level: those of a square grid that are within the container.
fn level(container: Container, reach: f64) -> Vec<[f64; 2]> {
    let pitch = 2.0 * ROOM * reach;
    let along = |from: f64, length: f64| {
        let count = (length / pitch).floor().min(MOST_ALONG) as usize;
        let step = length / count.max(1) as f64;
        (0..count).map(move |at| from + step * (at as f64 + 0.5))
    };
    let grid = |from: [f64; 2], [width, depth]: [f64; 2]| -> Vec<[f64; 2]> {
        let rows = along(from[1], depth);
        rows.flat_map(|y| along(from[0], width).map(move |x| [x, y]))
            .collect()
    };
    match container {
        Container::Box(sides) => grid([0.0; 2], sides),
        Container::Cylinder(radius) => {
            let mut places = grid([-radius; 2], [2.0 * radius; 2]);
            places.retain(|[x, y]| x.hypot(*y) + reach < radius);
            // A grid of an even number of places has none on the axis, where a narrow cylinder has room.
            if places.is_empty() && reach < radius {
                places.push([0.0; 2]);
            }
            places
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grain_that_fits_into_a_cylinder_has_a_place_there() {
        for reach in [0.99, 0.6, 0.49, 0.48, 0.35, 0.2] {
            assert!(
                !level(Container::Cylinder(1.0), reach).is_empty(),
                "{reach}"
            );
        }
        assert!(level(Container::Cylinder(1.0), 1.01).is_empty());
    }

    #[test]
    fn shares_become_counts_that_add_up() {
        assert_eq!(counts(10, &[1.0, 1.0, 1.0]).unwrap(), [4, 3, 3]);
        assert_eq!(counts(1500, &[0.3, 0.7]).unwrap(), [450, 1050]);
        for none in [&[][..], &[0.0], &[-1.0, 2.0], &[f64::NAN]] {
            assert_eq!(counts(10, none), Err(BedError::NoKinds));
        }
    }
}
