//! What the points say of a rim that the estimate does not.
//!
//! As with [tips](super::tips): what the prior takes of a rim for noise is left in the residuals there, and over a whole
//! rim the area lacks more than its standard error. A rim is a bump around a circle at the polar angle t of one of the axes of
//! the stretched space: the mean of [bumps](super::bump) about its points. Height and variance are those of a tip, with what is
//! expected before a point is seen, of the width, circle and axis under which the points are most likely.
//!
//! What is found so is a rounded rim still, and has .2 to .6 of the area that is missing. Measured on lenses 2.5 to
//! 10 times as wide as thick, and on ones of unequal halves, of 1500 and 6000 points with noise of .1 to 2 % of the mean
//! radius: their areas were 2 to 14 standard errors too small, and with four times this as an allowance .5 to 2.8.

use super::bump::{EXPECTED, HIGHEST, LegendreBump, falls};
use super::cloud::Cloud;
use super::functionals::RingSurface;
use super::outcome::Estimate;
use crate::measure::Moments;
use crate::vectorize::dot;
use nalgebra::Vector3;
use std::f64::consts::PI;

/// k of the bumps: Gaussians of 14, 10, 7, 5 and 3.5 degrees.
const SHARPNESSES: [f64; 5] = [16.0, 32.0, 64.0, 128.0, 256.0];

/// Residuals are summed over as many bands of the polar angle.
const BANDS: usize = 180;

/// Bands from one circle to the next.
const STEP: usize = 5;

/// How much likelier the points are with a rim, as twice the logarithm: four standard deviations of its height.
const CLEAR: f64 = 16.0;

/// A rim that the estimate lacks.
pub(super) struct Rim {
    axis: usize,
    /// By degree, of the Legendre polynomials in the cosine of the polar angle: what is missing of the radius, in units of the mean.
    missing: Vec<f64>,
    /// Twice the logarithm of how much likelier it makes the points.
    gain: f64,
}

impl Rim {
    /// The rim that the residuals of the points tell of most clearly, if they do.
    pub(super) fn of(estimate: &Estimate, residuals: &[f64]) -> Option<Self> {
        let noise = estimate.spectrum.noise().powi(2);
        let sums = [0, 1, 2].map(|axis| band_sums(&estimate.cloud, residuals, axis));
        let at_band = |band: usize| polynomials(middle(band).cos());
        let at_bands: Vec<[f64; HIGHEST]> = (0..BANDS).map(at_band).collect();
        let mut best: Option<Self> = None;
        for falls in SHARPNESSES.map(falls) {
            for circle in at_bands.iter().step_by(STEP) {
                let bump = LegendreBump::new(&falls, circle, &estimate.unlearnt);
                let degrees = bump.series.len();
                let heights = at_bands.iter().map(|p| dot(&p[..degrees], &bump.series));
                let heights: Vec<f64> = heights.collect();
                for (axis, sums) in sums.iter().enumerate() {
                    let [mut score, mut squares] = [0.0; 2];
                    for (height, [of_residuals, of_weights]) in heights.iter().zip(sums) {
                        score += height * of_residuals / noise;
                        squares += height * height * of_weights / noise;
                    }
                    let information = squares * bump.left_of_squares + EXPECTED.powi(-2);
                    let gain = score * score / information;
                    if gain > best.as_ref().map_or(CLEAR, |best| best.gain) {
                        let height = score / information;
                        best = Some(Self {
                            axis,
                            missing: bump.left.iter().map(|b| height * b).collect(),
                            gain,
                        });
                    }
                }
            }
        }
        best
    }

    /// Area, volume and moments with it, to 1 % of what it adds.
    pub(super) fn moments(&self, surface: &RingSurface) -> Moments {
        let axis = Vector3::ith(self.axis, 1.0);
        let at_bands: Vec<[f64; 2]> = (0..BANDS)
            .map(|band| series(&self.missing, middle(band).cos()))
            .collect();
        surface.moments_with(|n| {
            let z = n[self.axis];
            let place = (bands(z) - 0.5).clamp(0.0, (BANDS - 1) as f64);
            let before = (place as usize).min(BANDS - 2);
            let share = place - before as f64;
            let between =
                |of: usize| (1.0 - share) * at_bands[before][of] + share * at_bands[before + 1][of];
            (between(0), (axis - n * z) * between(1))
        })
    }
}

/// The polar angle of this cosine, in bands.
fn bands(z: f64) -> f64 {
    z.clamp(-1.0, 1.0).acos() / PI * BANDS as f64
}

/// The polar angle in the middle of a band.
fn middle(band: usize) -> f64 {
    PI * (band as f64 + 0.5) / BANDS as f64
}

/// Sums of weights times residuals, and of weights, over the bands about an axis.
fn band_sums(cloud: &Cloud, residuals: &[f64], axis: usize) -> [[f64; 2]; BANDS] {
    let mut sums = [[0.0; 2]; BANDS];
    let weighted = residuals.iter().zip(&cloud.weights);
    for (n, (e, w)) in cloud.directions.iter().zip(weighted) {
        let band = bands(n[axis]) as usize;
        let [of_residuals, of_weights] = &mut sums[band.min(BANDS - 1)];
        *of_residuals += w * e;
        *of_weights += w;
    }
    sums
}

/// The Legendre polynomials at z.
fn polynomials(z: f64) -> [f64; HIGHEST] {
    let mut found = [1.0; HIGHEST];
    found[1] = z;
    for l in 1..HIGHEST - 1 {
        let n = l as f64;
        found[l + 1] = ((2.0 * n + 1.0) * z * found[l] - n * found[l - 1]) / (n + 1.0);
    }
    found
}

/// A sum of Legendre polynomials at z, and its derivative by z.
fn series(coefficients: &[f64], z: f64) -> [f64; 2] {
    let values = polynomials(z);
    let mut slopes = [0.0, 1.0];
    let mut sums = [0.0; 2];
    for (l, (coefficient, value)) in coefficients.iter().zip(values).enumerate() {
        sums[0] += coefficient * value;
        sums[1] += coefficient * slopes[0];
        // P'_(l+2) = (2 l + 3) P_(l+1) + P'_l
        let next = values.get(l + 1).map_or(0.0, |p| (2 * l + 3) as f64 * p);
        slopes = [slopes[1], next + slopes[0]];
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::super::trial::{estimated, fibonacci, lens, samples};
    use super::*;
    use approx::assert_relative_eq;

    fn rim(estimate: &Estimate) -> Option<Rim> {
        let residuals = estimate.posterior().residuals(&estimate.coefficients);
        Rim::of(estimate, &residuals)
    }

    /// The points about a hole lie a little outside.
    #[test]
    fn no_large_rim_is_seen_over_a_hole() {
        let all = fibonacci(4000).into_iter();
        let seen: Vec<Vector3<f64>> = all.filter(|n| n.z < 0.4_f64.cos()).collect();
        let found = estimated(
            &samples(&seen, |n| 3.0 + 0.1 * n.x, 1e-4),
            Vector3::repeat(3.0),
        );
        let noise = found.spectrum.noise();
        let about_hole = |n: &Vector3<f64>| n.z > 0.5_f64.cos();
        let directions = found.cloud.directions.iter();
        let off = directions.map(|n| if about_hole(n) { 2.0 * noise } else { 0.0 });
        let rim = Rim::of(&found, &off.collect::<Vec<_>>()).expect("a rim");
        let surface = RingSurface::new(&found);
        let added = rim.moments(&surface).area / surface.moments().area - 1.0;
        assert!(added.abs() < 0.1, "{added}");
    }

    #[test]
    fn a_lens_in_noise_lacks_the_rim_that_is_found() {
        for half in [1.5, 2.0] {
            let found = estimated(&lens(half), Vector3::new(5.0, 5.0, half));
            let surface = RingSurface::new(&found);
            let rim = rim(&found).expect("a rim");
            let is_across = |n: &Vector3<f64>| n[rim.axis].abs() < 0.1;
            assert!(is_across(&Vector3::x()) && is_across(&Vector3::y()));
            let before = surface.moments().area;
            let added = rim.moments(&surface).area - before;
            let missing = 2.0 * PI * (25.0 + half * half) - before;
            let share = added / missing;
            assert!((0.2..0.8).contains(&share), "{added} of {missing}");
        }
    }

    #[test]
    fn bodies_without_a_rim_have_none_in_noise() {
        for axes in [[1.0, 1.0, 1.0], [2.0, 1.5, 1.0]].map(Vector3::from) {
            let radius = |n: &Vector3<f64>| 1.0 / n.component_div(&axes).norm();
            let found = estimated(&samples(&fibonacci(1500), radius, 0.02), axes);
            assert!(rim(&found).is_none());
        }
    }

    /// P_4 is (35 z^4 - 30 z^2 + 3) / 8.
    #[test]
    fn series_and_slopes_are_those_of_legendre() {
        for z in [-1.0, -0.3, 0.0, 0.8, 1.0_f64] {
            let [value, slope] = series(&[0.0, 2.0, 0.0, 0.0, 8.0], z);
            let fourth = 35.0 * z.powi(4) - 30.0 * z * z + 3.0;
            assert_relative_eq!(value, 2.0 * z + fourth, epsilon = 1e-12);
            assert_relative_eq!(slope, 2.0 + 140.0 * z.powi(3) - 60.0 * z, epsilon = 1e-11);
        }
    }
}
