//! Scans of a body whose radius is known: whole, half of it thin, with a hole.

use crate::truth::Truth;
use grainform::scan::Scan;
use grainform::shapes::Sampling;
use nalgebra::{Point3, Vector3};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal, UnitSphere};
use std::error::Error;
use std::fmt;

/// Which points a scan has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Layout {
    /// Evenly spread ones.
    Whole,
    /// Of half of the body one in eight.
    Thin,
    /// None in a cap of a half-angle of 20 degrees.
    Hole,
}

/// One in so many points of the thin half.
const THIN: u32 = 8;

/// Half-angle of the hole in degrees.
const HOLE: f64 = 20.0;

impl Layout {
    /// A scan with normal radial noise, as a share of the mean radius; where it is thin, or has its hole, is drawn with
    /// the seed.
    pub(crate) fn scan(
        self,
        truth: &Truth,
        points: usize,
        noise: f64,
        seed: u64,
    ) -> Result<Scan, Box<dyn Error>> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let pole = Vector3::from(UnitSphere.sample(&mut random));
        let directions = Sampling::Cube.directions(points, 0)?;
        let mut places = Vec::with_capacity(directions.len());
        for n in directions {
            let error: f64 = StandardNormal.sample(&mut random);
            let is_one_of_few = random.next_u32() % THIN == 0;
            let is_seen = match self {
                Self::Whole => true,
                Self::Thin => n.dot(&pole) > 0.0 || is_one_of_few,
                Self::Hole => n.dot(&pole) < HOLE.to_radians().cos(),
            };
            if is_seen {
                let radius = truth.radius(&n) + noise * truth.mean_radius * error;
                places.push(Point3::from(n * radius));
            }
        }
        Ok(Scan::from_points(places))
    }
}

impl fmt::Display for Layout {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Whole => "whole",
            Self::Thin => "half thin",
            Self::Hole => "hole",
        })
    }
}
