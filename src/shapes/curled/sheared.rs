//! A ball, sheared several times at random.
//!
//! A shear x -> x + d sin(k . x + c) with d normal to k moves all of space one to one and keeps volumes. So however
//! often a ball is sheared, its surface never meets itself, and its volume is that of the ball.

use super::{CurledTruth, OverSphere};
use crate::measure::Moments;
use crate::shapes::random::{Stream, random};
use crate::sphere::GaussLegendre;
use nalgebra::{Matrix3, Point3, Vector3};
use rand_distr::{Distribution, Uniform, UnitSphere};
use std::f64::consts::{PI, TAU};

/// Number of shears.
const SHEARS: usize = 6;

/// Wave numbers, and how far points are moved at most, for a ball of radius 1.
const WAVE_NUMBERS: [f64; 2] = [1.5, 3.0];
const LENGTHS: [f64; 2] = [0.4, 0.8];

/// Gauss nodes along a meridian of the first rule, twice as many in the next ...
const ORDER: usize = 48;

/// ... until two agree as well, or there are so many.
const AGREEMENT: f64 = 1e-12;
const MOST_NODES: usize = 768;

/// Relative error of sums of so many terms.
const ROUNDING: f64 = 1e-14;

/// A ball of radius 1 after some shears.
#[derive(Debug, Clone)]
pub(super) struct Sheared {
    shears: [Shear; SHEARS],
}

#[derive(Debug, Clone, Copy)]
struct Shear {
    wave: Vector3<f64>,
    phase: f64,
    along: Vector3<f64>,
}

impl Sheared {
    /// The body of a seed.
    pub(super) fn of_seed(seed: u64) -> Self {
        let mut generator = random(seed, Stream::Shape);
        let mut shear = || {
            let mut between = |[least, most]: [f64; 2]| {
                let range = Uniform::new(least, most).expect("constants in order");
                range.sample(&mut generator)
            };
            let (number, length) = (between(WAVE_NUMBERS), between(LENGTHS));
            let phase = between([0.0, TAU]);
            let normal = Vector3::from(UnitSphere.sample(&mut generator));
            let aside = Vector3::from(UnitSphere.sample(&mut generator));
            let across = normal.cross(&aside);
            Shear {
                wave: normal * number,
                phase,
                along: across.try_normalize(1e-12).unwrap_or_default() * length,
            }
        };
        Self {
            shears: std::array::from_fn(|_| shear()),
        }
    }

    fn moments(&self, order: usize) -> Moments {
        let rule = GaussLegendre::new(order);
        let step = PI / order as f64;
        let mut sum = Moments::default();
        for (z, weight) in rule.on(-1.0, 1.0) {
            let r = (1.0 - z * z).sqrt();
            for i in 0..2 * order {
                let (sin, cos) = (step * i as f64).sin_cos();
                let (place, area) = self.place_and_area(&Vector3::new(r * cos, r * sin, z));
                sum.add_element(&place, &(area * (weight * step)));
            }
        }
        sum
    }
}

impl OverSphere for Sheared {
    fn place_and_area(&self, n: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
        let (mut place, mut slopes) = (*n, Matrix3::identity());
        for shear in &self.shears {
            let (sin, cos) = (shear.wave.dot(&place) + shear.phase).sin_cos();
            place += shear.along * sin;
            slopes = (Matrix3::identity() + shear.along * shear.wave.transpose() * cos) * slopes;
        }
        // Areas go with the cofactors, here the inverse transpose, for the determinant is 1.
        let [a, b, c] = [0, 1, 2].map(|row| Vector3::from(slopes.row(row).transpose()));
        let cofactors = Matrix3::from_columns(&[b.cross(&c), c.cross(&a), a.cross(&b)]);
        (place, cofactors.transpose() * n)
    }

    fn integrals(&self) -> CurledTruth {
        let off = |one: f64, other: f64| (one / other - 1.0).abs();
        let mut order = ORDER;
        let mut sum = self.moments(order);
        let mut error = f64::INFINITY;
        while error > AGREEMENT && 2 * order <= MOST_NODES {
            order *= 2;
            let finer = self.moments(order);
            error = off(finer.area, sum.area).max(off(finer.volume, sum.volume));
            sum = finer;
        }
        CurledTruth {
            properties: sum.about_centroid(&Point3::origin()),
            relative_error: error.max(ROUNDING),
        }
    }
}
