//! What the points of a scan tell of the ends of its lengths that errors of coefficients do not.
//!
//! At a sharp edge a smooth surface swings over, most between points, and stays below a crease. So the squared error of an end
//! grows by squares, each as far as it is more than chance:
//!
//! - how far the highest foot of a point lies below the end: what is higher no point has seen;
//! - how far the highest point lies below where noise about the feet would lift it: along a flat side there are
//!   many, and of a surface that swings over they know nothing;
//! - the mean distance of the points nearest to the end, which is zero where the surface follows them;
//! - of voxels, how far the highest point lies above the end, or the end of a [tip](super::taper) that they cut off.

use super::cloud::Cloud;
use super::functionals::End;
use super::taper::beyond;
use crate::fit::points::neighbours::Neighbours;
use nalgebra::Vector3;
use std::f64::consts::SQRT_2;

/// Points nearest to an end whose mean distance is looked at.
const NEAREST: [usize; 2] = [4, 16];

/// Depth below an end in which feet count, in standard deviations of the noise, and steps in each.
const DEPTH: usize = 6;
const STEPS: usize = 8;

/// Halvings of the range in which the highest point is looked for.
const HALVINGS: usize = 16;

/// The chance that a number is lower than its mean by more than a standard deviation.
const ONE_LOWER: f64 = 0.16;

/// Standard deviations by which points between voxels lie beside a smooth body at most.
const OF_NOISE: f64 = 2.0;

/// A point of a scan.
struct Seen<'a> {
    point: &'a Vector3<f64>,
    /// The place of the surface in its direction.
    foot: &'a Vector3<f64>,
    /// Its distance from the surface along the normal.
    distance: f64,
}

/// The points of a scan, seen from the ends of lengths.
pub(super) struct Ends<'a> {
    seen: Vec<Seen<'a>>,
    /// Their feet, by place.
    feet: Neighbours,
    /// Of the distances.
    rms: f64,
}

impl<'a> Ends<'a> {
    /// From a surface's places in the directions of all samples, and their distances from it.
    pub(super) fn new(
        cloud: &'a Cloud<'_>,
        feet: &'a [Vector3<f64>],
        distances: &[f64],
        rms: f64,
    ) -> Self {
        let points = (0..feet.len()).filter(|&at| cloud.is_point(at));
        let seen = points.map(|at| Seen {
            point: &cloud.points[at],
            foot: &feet[at],
            distance: distances[at],
        });
        Self::of(seen.collect(), rms)
    }

    fn of(seen: Vec<Seen<'a>>, rms: f64) -> Self {
        let feet: Vec<_> = seen.iter().map(|seen| *seen.foot).collect();
        Self {
            feet: Neighbours::new(&feet),
            seen,
            rms,
        }
    }

    /// Square of the error of an end beyond that of its coefficients.
    pub(super) fn square(&self, end: &End) -> f64 {
        let below = |place: &Vector3<f64>| (end.point - place).dot(&end.along);
        let feet: Vec<f64> = self.seen.iter().map(|seen| below(seen.foot)).collect();
        let points = self.seen.iter().map(|seen| below(seen.point));
        let foot = feet.iter().copied().fold(f64::INFINITY, f64::min);
        let point = points.fold(f64::INFINITY, f64::min);
        foot.max(0.0).powi(2) + self.too_low(&feet, point) + self.missed(end)
    }

    /// Square of how much farther than an end a body of such a length may reach, seen between voxels of this width: to the highest point,
    /// as far as that is no noise, or where a [tip](beyond) ends.
    pub(super) fn cut_off(&self, end: &End, [width, length]: [f64; 2]) -> f64 {
        let points = || self.seen.iter().map(|seen| *seen.point);
        let height = end.point.dot(&end.along);
        let highest = points().map(|point| point.dot(&end.along) - height);
        let above = highest.fold(0.0, f64::max).powi(2) - (OF_NOISE * self.rms).powi(2);
        let tip = beyond(points(), height, &end.along, [width, length]);
        above.max(tip * tip)
    }

    /// Square of how much lower the highest point is than noise about the feet would lift it. `feet` and `point` are below
    /// the end by so much.
    fn too_low(&self, feet: &[f64], point: f64) -> f64 {
        let mut counts = [0.0; DEPTH * STEPS];
        for foot in feet {
            let step = (foot.max(0.0) / self.rms * STEPS as f64) as usize;
            if let Some(count) = counts.get_mut(step) {
                *count += 1.0;
            }
        }
        let higher_than = |height: f64| -> f64 {
            let chance = |(step, count): (usize, &f64)| {
                let sds = height + (step as f64 + 0.5) / STEPS as f64;
                0.5 * count * libm::erfc(sds / SQRT_2)
            };
            counts.iter().enumerate().map(chance).sum()
        };
        // The number of points above a height is Poisson-distributed: that there is none has the chance exp(-mean).
        let highest = |chance: f64| {
            let (mut low, mut high) = (-(DEPTH as f64), DEPTH as f64);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (low + high);
                match higher_than(middle) > -chance.ln() {
                    true => low = middle,
                    false => high = middle,
                }
            }
            low * self.rms
        };
        let median = highest(0.5);
        let lack = (median + point).max(0.0);
        (lack.powi(2) - (median - highest(ONE_LOWER)).powi(2)).max(0.0)
    }

    /// Mean square of the distance of the points nearest to an end, but for that of noise.
    fn missed(&self, end: &End) -> f64 {
        let square = |&count: &usize| {
            let near = self.feet.nearest(&end.point, count);
            let sum: f64 = near.iter().map(|&at| self.seen[at].distance).sum();
            let count = count as f64;
            (sum / count).powi(2) - self.rms.powi(2) / count
        };
        NEAREST.iter().map(square).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    const NOISE: f64 = 0.01;

    /// Points per side.
    const SIDE: usize = 40;

    /// Points scattered about a square of sides 2 in z = 0, and an end above its middle.
    struct Flat {
        points: Vec<Vector3<f64>>,
        feet: Vec<Vector3<f64>>,
    }

    impl Flat {
        fn new(seed: u64, noise: f64, surface: impl Fn(f64, f64) -> f64) -> Self {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            let mut draw = || -> f64 { StandardNormal.sample(&mut random) };
            let place = |i: usize| (2 * i + 1) as f64 / SIDE as f64 - 1.0;
            let places = (0..SIDE * SIDE).map(|at| (place(at % SIDE), place(at / SIDE)));
            let places: Vec<(f64, f64)> = places.collect();
            let points = places.iter();
            let feet = places.iter();
            Self {
                points: points
                    .map(|&(x, y)| Vector3::new(x, y, noise * draw()))
                    .collect(),
                feet: feet
                    .map(|&(x, y)| Vector3::new(x, y, surface(x, y)))
                    .collect(),
            }
        }

        fn ends(&self) -> Ends<'_> {
            let seen = self
                .points
                .iter()
                .zip(&self.feet)
                .map(|(point, foot)| Seen {
                    point,
                    foot,
                    distance: point.z - foot.z,
                });
            Ends::of(seen.collect(), NOISE)
        }

        /// The root of the square that is told of an end at this height.
        fn told(&self, height: f64) -> f64 {
            let end = End {
                figure: 0,
                point: Vector3::new(0.0, 0.0, height),
                along: Vector3::z(),
            };
            self.ends().square(&end).sqrt()
        }
    }

    #[test]
    fn what_is_above_an_end_by_more_than_voxels_explain_was_cut_off() {
        let mut flat = Flat::new(7, 0.0, |_, _| 0.0);
        let end = End {
            figure: 0,
            point: Vector3::zeros(),
            along: Vector3::z(),
        };
        flat.points[820].z = OF_NOISE * NOISE;
        assert_eq!(flat.ends().cut_off(&end, [NOISE, 1.0]), 0.0);
        flat.points[820].z = 5.0 * NOISE;
        let told = flat.ends().cut_off(&end, [NOISE, 1.0]).sqrt() / NOISE;
        assert!((told - 21.0_f64.sqrt()).abs() < 1e-9, "{told}");
    }

    /// The root of the mean square that is told with fifty draws of noise.
    fn mean_told(surface: impl Fn(f64, f64) -> f64, height: f64) -> f64 {
        let told = (0..50).map(|seed| Flat::new(seed, NOISE, &surface).told(height));
        (told.map(|told| told * told).sum::<f64>() / 50.0).sqrt()
    }

    #[test]
    fn a_flat_side_that_noise_lies_about_is_where_it_is() {
        let told = mean_told(|_, _| 0.0, 0.0);
        assert!(told < 0.5 * NOISE, "{told}");
    }

    #[test]
    fn an_end_above_all_feet_is_unsure_by_as_much() {
        let flat = Flat::new(7, NOISE, |_, _| 0.0);
        let (without, with) = (flat.told(0.0), flat.told(0.05));
        let added = (with.powi(2) - without.powi(2)).sqrt();
        assert!((added - 0.05).abs() < 0.01, "{added}");
    }

    /// Half of the side is two standard deviations too high; the mean of the points nearest to the middle tells nothing.
    #[test]
    fn a_surface_above_its_points_is_told_by_the_highest_of_them() {
        let swung = |x: f64, _: f64| if x.abs() > 0.5 { 2.0 * NOISE } else { 0.0 };
        let told = mean_told(swung, 2.0 * NOISE);
        assert!((1.3..2.3).contains(&(told / NOISE)), "{told}");
    }

    #[test]
    fn a_crease_that_the_surface_cuts_off_is_told_by_the_points_near_it() {
        let cut = |x: f64, y: f64| {
            if x.hypot(y) < 0.12 {
                -3.0 * NOISE
            } else {
                -0.1
            }
        };
        let flat = Flat::new(7, 0.0, cut);
        let told = flat.told(-3.0 * NOISE);
        assert!((2.0..4.0).contains(&(told / NOISE)), "{told}");
    }
}
