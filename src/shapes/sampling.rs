//! Where a synthetic scan looks: sets of directions.

use super::random::{Stream, random};
use crate::digits::plural;
use nalgebra::Vector3;
use rand_distr::{Distribution, UnitSphere};
use std::f64::consts::{FRAC_PI_4, PI, TAU};
use std::fmt;
use std::str::FromStr;
use thiserror::Error;

/// Fewest directions that can be asked for: those of a tetrahedron.
pub const MIN_POINTS: usize = 4;

/// Most directions that can be asked for.
pub const MAX_POINTS: usize = 100_000_000;

/// A layout of directions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Sampling {
    /// The surface points of a cube with n cells per edge, equal in angle: 6 n² + 2 directions. With
    /// n = 2^s the cube is subdivided s times: 1538 directions for s = 4, 6146 for s = 5.
    Cube,
    /// The spherical Fibonacci lattice (Swinbank and Purser 2006): even, for any number.
    Fibonacci,
    /// n equal steps in the polar angle and 2 n in azimuth, one direction at each pole:
    /// 2 n (n - 1) + 2 directions, dense at the poles as those of a turntable scanner.
    Rings,
    /// Independent, uniform on the sphere, drawn with the seed.
    Random,
}

/// Why there are no directions.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum SamplingError {
    /// Ask for [`MIN_POINTS`] to [`MAX_POINTS`] directions.
    #[error("cannot sample {}, only {MIN_POINTS} to {MAX_POINTS}", plural(*points, "direction"))]
    PointCount {
        /// The number asked for.
        points: usize,
    },
}

/// A name that no [`Sampling`] has.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("there is no sampling named {name:?}; known are {}", Sampling::ALL.map(Sampling::name).join(", "))]
pub struct UnknownSampling {
    /// The name asked for.
    pub name: String,
}

impl Sampling {
    /// All layouts.
    pub const ALL: [Self; 4] = [Self::Cube, Self::Fibonacci, Self::Rings, Self::Random];

    /// The name, in lower case.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Cube => "cube",
            Self::Fibonacci => "fibonacci",
            Self::Rings => "rings",
            Self::Random => "random",
        }
    }

    /// Unit vectors of this layout, the same ones for the same arguments.
    ///
    /// `points` is met exactly by `Fibonacci` and `Random`. The others take the n whose count comes
    /// nearest, at least 8 directions for `Cube` and 6 for `Rings`: the length says how many it
    /// became. Only `Random` looks at the seed.
    ///
    /// # Errors
    ///
    /// When `points` is out of range.
    pub fn directions(self, points: usize, seed: u64) -> Result<Vec<Vector3<f64>>, SamplingError> {
        if !(MIN_POINTS..=MAX_POINTS).contains(&points) {
            return Err(SamplingError::PointCount { points });
        }
        Ok(match self {
            Self::Cube => cube(nearest(1, points, |n| 6 * n * n + 2)),
            Self::Fibonacci => fibonacci(points),
            Self::Rings => rings(nearest(2, points, |n| 2 * n * (n - 1) + 2)),
            Self::Random => {
                let mut generator = random(seed, Stream::Directions);
                (0..points)
                    .map(|_| Vector3::from(UnitSphere.sample(&mut generator)))
                    .collect()
            }
        })
    }
}

impl fmt::Display for Sampling {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Sampling {
    type Err = UnknownSampling;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        Self::ALL
            .into_iter()
            .find(|sampling| sampling.name() == name)
            .ok_or_else(|| UnknownSampling { name: name.into() })
    }
}

/// The n from `least` upwards whose count, growing with n, is nearest to `points`.
fn nearest(least: usize, points: usize, count: impl Fn(usize) -> usize) -> usize {
    let mut n = least;
    while count(n + 1).abs_diff(points) < count(n).abs_diff(points) {
        n += 1;
    }
    n
}

/// The surface points of a lattice of n cells per edge, at the tangents of equal angles.
fn cube(n: usize) -> Vec<Vector3<f64>> {
    let tangent = |i: usize| (FRAC_PI_4 * (2.0 * i as f64 / n as f64 - 1.0)).tan();
    let is_border = |i: usize| i == 0 || i == n;
    let mut directions = Vec::with_capacity(6 * n * n + 2);
    for i in 0..=n {
        for j in 0..=n {
            let step = if is_border(i) || is_border(j) { 1 } else { n };
            for k in (0..=n).step_by(step) {
                directions.push(Vector3::new(tangent(i), tangent(j), tangent(k)).normalize());
            }
        }
    }
    directions
}

/// Heights in the middle of `points` equal slices, azimuths a golden ratio of a turn apart.
fn fibonacci(points: usize) -> Vec<Vector3<f64>> {
    let golden = (5.0_f64.sqrt() - 1.0) / 2.0;
    (0..points)
        .map(|i| {
            let z = 1.0 - (2 * i + 1) as f64 / points as f64;
            on_ring(z.acos(), TAU * (i as f64 * golden).fract())
        })
        .collect()
}

/// Both poles and n - 1 rings of 2 n directions.
fn rings(n: usize) -> Vec<Vector3<f64>> {
    let step = PI / n as f64;
    let between = (1..n).flat_map(|i| (0..2 * n).map(move |j| (i as f64 * step, j as f64 * step)));
    std::iter::once(Vector3::z())
        .chain(between.map(|(theta, phi)| on_ring(theta, phi)))
        .chain(std::iter::once(-Vector3::z()))
        .collect()
}

fn on_ring(theta: f64, phi: f64) -> Vector3<f64> {
    let (sin_theta, cos_theta) = theta.sin_cos();
    let (sin_phi, cos_phi) = phi.sin_cos();
    Vector3::new(sin_theta * cos_phi, sin_theta * sin_phi, cos_theta)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn count(sampling: Sampling, points: usize) -> usize {
        sampling.directions(points, 1).unwrap().len()
    }

    #[test]
    fn counts_are_exact_or_nearest() {
        for points in [8, 26, 98, 386, 1538, 6146] {
            assert_eq!(count(Sampling::Cube, points), points);
        }
        assert_eq!(count(Sampling::Cube, 4), 8);
        assert_eq!(count(Sampling::Cube, 1000), 6 * 13 * 13 + 2);
        assert_eq!(count(Sampling::Rings, 4), 6);
        assert_eq!(count(Sampling::Rings, 1000), 2 * 23 * 22 + 2);
        assert_eq!(count(Sampling::Fibonacci, 4), 4);
        assert_eq!(count(Sampling::Random, 777), 777);
    }

    #[test]
    fn counts_out_of_range_are_refused() {
        for points in [0, 3, MAX_POINTS + 1, usize::MAX] {
            let refused = Sampling::Cube.directions(points, 0);
            assert_eq!(refused, Err(SamplingError::PointCount { points }));
        }
    }

    #[test]
    fn only_random_directions_depend_on_the_seed() {
        for sampling in Sampling::ALL {
            let same = sampling.directions(500, 1) == sampling.directions(500, 2);
            assert_eq!(same, sampling != Sampling::Random);
            assert_eq!(sampling.directions(500, 1), sampling.directions(500, 1));
        }
    }

    #[test]
    fn names_round_trip() {
        for sampling in Sampling::ALL {
            assert_eq!(sampling.to_string().parse(), Ok(sampling));
        }
        assert!("spiral".parse::<Sampling>().is_err());
    }

    proptest! {
        #[test]
        fn directions_are_distinct_unit_vectors_about_the_origin(
            points in 4..3000_usize,
            which in 0..3_usize,
        ) {
            let directions = Sampling::ALL[which].directions(points, 0).unwrap();
            prop_assert!(directions.iter().all(|n| (n.norm() - 1.0).abs() < 1e-14));
            let mean = directions.iter().sum::<Vector3<f64>>() / directions.len() as f64;
            prop_assert!(mean.norm() < 1.0 / directions.len() as f64);
            let mut keys: Vec<[i64; 3]> = directions
                .iter()
                .map(|n| [n.x, n.y, n.z].map(|c| (c * 1e9).round() as i64))
                .collect();
            keys.sort_unstable();
            keys.dedup();
            prop_assert_eq!(keys.len(), directions.len());
        }
    }
}
