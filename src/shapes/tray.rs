//! A synthetic tray: many grains on a plane, of which it is known which point belongs to which.
//!
//! Grains of several shapes, sizes and headings lie on a slightly tilted plane, some in pairs that touch. Every surface
//! has as many points per area as any other, laid at random. What a grain hides from above is not seen of the plane,
//! and dust hovers between the grains.

use super::lying::{KINDS, Lying, ROUND};
use super::random::{Stream, random};
use super::{MAX_NOISE, MAX_POINTS, SamplingError};
use nalgebra::{Point3, Rotation3, Vector3};
use rand_distr::{Distribution, StandardNormal, StandardUniform, UnitSphere};
use std::ops::RangeInclusive;
use thiserror::Error;

/// Numbers of grains that a tray can have.
pub const TRAY_GRAINS: RangeInclusive<usize> = 2..=10_000;

/// Points per grain, the plane's included, from which a grain is a grain.
const LEAST_POINTS: usize = 100;

/// Sides along x and y of the place of one grain, or of a pair that touches.
const PITCH: [f64; 2] = [34.0, 18.0];

/// Angle between the plane and x and y, in radians.
const TILT: f64 = 0.1;

/// Specks of dust per grain, points of a speck, and its radius.
const SPECKS: usize = 2;
const SPECK_POINTS: usize = 4;
const SPECK_RADIUS: f64 = 0.1;

/// How far dust keeps from everything else.
const CLEARANCE: f64 = 2.5;

/// What lies on a tray.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct TrayOptions {
    /// Number of grains, within [`TRAY_GRAINS`]; two in ten lie in pairs that touch.
    pub grains: usize,
    /// Number of points of grains and plane, met to a few percent.
    pub points: usize,
    /// Standard deviation of the noise along x, y and z, as a share of a radius of 4 mm: 0 to [`MAX_NOISE`].
    pub noise: f64,
    /// Seed of everything random.
    pub seed: u64,
}

impl TrayOptions {
    /// A clean tray with 6000 points per grain, two thirds of them on the plane.
    pub fn clean(grains: usize) -> Self {
        Self {
            grains,
            points: grains.saturating_mul(6000),
            noise: 0.0,
            seed: 0,
        }
    }

    /// The same with another number of [`points`](Self::points).
    pub fn with_points(self, points: usize) -> Self {
        Self { points, ..self }
    }

    /// The same with this [`noise`](Self::noise).
    pub fn with_noise(self, noise: f64) -> Self {
        Self { noise, ..self }
    }

    /// The same with another [`seed`](Self::seed).
    pub fn with_seed(self, seed: u64) -> Self {
        Self { seed, ..self }
    }
}

/// What a point was taken from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Origin {
    /// The plane.
    Plane,
    /// A speck of dust.
    Dust,
    /// A grain, counted from 0.
    Grain(usize),
}

/// Why there is no tray.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum TrayError {
    /// Ask for a number of grains within the range.
    #[error(
        "a tray has {} to {} grains, not {grains}",
        TRAY_GRAINS.start(),
        TRAY_GRAINS.end()
    )]
    Grains {
        /// The number asked for.
        grains: usize,
    },
    /// Ask for more points, or for fewer.
    #[error(
        "a tray of {grains} grains takes {least} points or more, and at most {MAX_POINTS}, not {points}"
    )]
    Points {
        /// The number asked for.
        points: usize,
        /// Number of grains.
        grains: usize,
        /// Fewest points.
        least: usize,
    },
    /// Give the noise as a share of a radius.
    #[error("the noise must lie between 0 and {MAX_NOISE} of the radius, not at {noise}")]
    Noise {
        /// The noise asked for.
        noise: f64,
    },
    /// A grain could not be felt.
    #[error(transparent)]
    Sampling(#[from] SamplingError),
}

/// A synthetic tray.
#[derive(Debug, Clone, PartialEq)]
pub struct SyntheticTray {
    /// The points, in millimetres, in no order.
    pub points: Vec<Point3<f64>>,
    /// What each of them was taken from.
    pub origins: Vec<Origin>,
    /// Pairs of grains that touch.
    pub touching: Vec<[usize; 2]>,
}

/// Scans a tray: the same points, bit for bit, for the same options.
///
/// # Errors
/// [`TrayError`] when an option is out of its range.
pub fn synthesize_tray(options: &TrayOptions) -> Result<SyntheticTray, TrayError> {
    check(options)?;
    let Layout {
        grains,
        touching,
        sides,
    } = lay_out(options)?;
    let plane = sides[0] * sides[1];
    let area: f64 = grains.iter().map(|grain| grain.area).sum::<f64>() + plane;
    let density = options.points as f64 / area;

    let mut directions = random(options.seed, Stream::Directions);
    let mut found: Vec<(Point3<f64>, Origin)> = Vec::with_capacity(options.points);
    for (number, grain) in grains.iter().enumerate() {
        let count = (density * grain.area).round() as usize;
        let points = grain.sample(count, &mut directions);
        found.extend(
            points
                .into_iter()
                .map(|point| (point, Origin::Grain(number))),
        );
    }
    let near = |point: &Point3<f64>| -> Vec<&Lying> {
        let is_near = |grain: &&Lying| (grain.at.xy() - point.xy()).norm() < PITCH[0];
        grains.iter().filter(is_near).collect()
    };
    let mut places = random(options.seed, Stream::Places);
    for _ in 0..(density * plane).round() as usize {
        let [x, y]: [f64; 2] = StandardUniform.sample(&mut places);
        let point = Point3::new(x * sides[0], y * sides[1], 0.0);
        if !near(&point).iter().any(|grain| grain.hides(&point)) {
            found.push((point, Origin::Plane));
        }
    }
    for _ in 0..SPECKS * options.grains {
        let middle = loop {
            let [x, y, z]: [f64; 3] = StandardUniform.sample(&mut places);
            let middle = Point3::new(x * sides[0], y * sides[1], CLEARANCE + 8.0 * z);
            if !near(&middle)
                .iter()
                .any(|grain| grain.holds(&middle, CLEARANCE))
            {
                break middle;
            }
        };
        for _ in 0..SPECK_POINTS {
            let n = Vector3::from(UnitSphere.sample(&mut places));
            found.push((middle + n * SPECK_RADIUS, Origin::Dust));
        }
    }

    let mut order = random(options.seed, Stream::Order);
    let mut keyed: Vec<(u64, (Point3<f64>, Origin))> = found
        .into_iter()
        .map(|point| (StandardUniform.sample(&mut order), point))
        .collect();
    keyed.sort_by_key(|(key, _)| *key);
    let mut noise = random(options.seed, Stream::Noise);
    let turn = Rotation3::from_euler_angles(TILT, -TILT, 0.0);
    let (points, origins) = keyed
        .into_iter()
        .map(|(_, (point, origin))| {
            let error = Vector3::from_fn(|_, _| StandardNormal.sample(&mut noise));
            (turn * (point + error * (4.0 * options.noise)), origin)
        })
        .unzip();
    Ok(SyntheticTray {
        points,
        origins,
        touching,
    })
}

fn check(options: &TrayOptions) -> Result<(), TrayError> {
    let &TrayOptions {
        grains,
        points,
        noise,
        ..
    } = options;
    if !TRAY_GRAINS.contains(&grains) {
        return Err(TrayError::Grains { grains });
    }
    let least = LEAST_POINTS * grains;
    if !(least..=MAX_POINTS).contains(&points) {
        return Err(TrayError::Points {
            points,
            grains,
            least,
        });
    }
    if !(0.0..=MAX_NOISE).contains(&noise) {
        return Err(TrayError::Noise { noise });
    }
    Ok(())
}

/// What lies where.
struct Layout {
    grains: Vec<Lying>,
    touching: Vec<[usize; 2]>,
    /// Of the plane.
    sides: [f64; 2],
}

/// Lays the grains down, row by row.
fn lay_out(options: &TrayOptions) -> Result<Layout, TrayError> {
    let pairs = options.grains / 10;
    let places = options.grains - pairs;
    let columns = (places as f64 * PITCH[1] / PITCH[0]).sqrt().ceil() as usize;
    let mut generator = random(options.seed, Stream::Places);
    let mut grains: Vec<Lying> = Vec::with_capacity(options.grains);
    let mut touching = Vec::with_capacity(pairs);
    for place in 0..places {
        let [x, y] = [place % columns, place / columns].map(|step| step as f64 + 0.5);
        let (x, y) = (x * PITCH[0], y * PITCH[1]);
        let first = grains.len();
        let kinds = if place < pairs { ROUND } else { KINDS.len() };
        let mut grain = Lying::new(first % kinds, &mut generator)?;
        (grain.at.x, grain.at.y) = (x, y);
        if place < pairs {
            let mut second = Lying::new((first + 1) % kinds, &mut generator)?;
            second.at.y = y;
            second.push_against(&grain);
            let shift = 0.5 * (second.at.x - x);
            grain.at.x -= shift;
            second.at.x -= shift;
            touching.push([first, first + 1]);
            grains.extend([grain, second]);
        } else {
            grains.push(grain);
        }
    }
    let rows = places.div_ceil(columns);
    let sides = [columns as f64 * PITCH[0], rows as f64 * PITCH[1]];
    Ok(Layout {
        grains,
        touching,
        sides,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn trays_of_more_grains_than_can_be_are_refused() {
        for grains in [usize::MAX, usize::MAX / 6000 + 1] {
            let found = synthesize_tray(&TrayOptions::clean(grains));
            assert_eq!(found, Err(TrayError::Grains { grains }));
        }
    }
}
