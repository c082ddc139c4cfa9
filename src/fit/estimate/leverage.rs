//! Leverage of points: how much of each the estimate follows.
//!
//! It is [computed](exact::Exact) of few points, [probed](mod@probed) of more whose matrix is factored, or whose residuals are no noise, and
//! [guessed](mod@guessed) of others, of which each matters little. What counts is 1 - h: the others miss a point by e / (1 - h)
//! that the estimate misses by e, a thousand times as much at the lone point on the tip of a spindle.

mod exact;
mod guessed;
mod probed;

use super::outcome::Estimate;
use exact::Exact;
use guessed::guessed;
use probed::probed;

/// Points of which every leverage is computed: that takes 7 % of a fit of so many.
const FEW: usize = 800;

impl Estimate {
    /// 1 - h of every point of the cloud.
    pub(super) fn spares(&self) -> &[f64] {
        match self.factor.is_some() && !self.has_few_points() {
            true => self.probed_spares(),
            false => self.steady_spares(),
        }
    }

    /// The same with probes, in which a cloud and its mirror image differ, only of detail.
    pub(super) fn steady_spares(&self) -> &[f64] {
        self.derived.steady_spares.get_or_init(|| {
            if self.has_few_points()
                && let Some(computed) = Exact::new(self).spares()
            {
                return computed;
            }
            match self.dense.is_none() && self.is_rough() {
                true => self.probed_spares().to_vec(),
                false => guessed(self),
            }
        })
    }

    fn probed_spares(&self) -> &[f64] {
        self.derived.probed_spares.get_or_init(|| probed(self))
    }

    /// Whether every leverage is computed.
    fn has_few_points(&self) -> bool {
        self.cloud.len() <= FEW
    }
}

#[cfg(test)]
mod tests {
    use super::super::dense::Factor;
    use super::super::posterior::Posterior;
    use super::super::trial::{estimated, fibonacci, samples};
    use super::*;
    use crate::sphere::{HarmonicBasis, coefficient_count};
    use nalgebra::Vector3;
    use std::sync::Arc;

    /// By its definition: w y'C y / s^2 of the harmonics y at each point.
    fn by_definition(estimate: &Estimate) -> Vec<f64> {
        let posterior = estimate.posterior();
        let mut given = estimate.given(&posterior);
        let gram = posterior.sums.gram(&estimate.cloud).lower_triangle();
        given.factor = Factor::double(&gram, &given.variances, given.noise).map(Arc::new);
        let basis = HarmonicBasis::new(estimate.degree);
        let rows = estimate.cloud.directions.iter().map(|n| {
            let mut row = vec![0.0; coefficient_count(estimate.degree)];
            basis.evaluate(n, &mut row);
            row
        });
        let rows: Vec<Vec<f64>> = rows.collect();
        let covariances = given.covariances(&rows);
        let noise = estimate.spectrum.noise().powi(2);
        let known = rows.iter().zip(&covariances).zip(&estimate.cloud.weights);
        known
            .map(|((row, known), weight)| {
                let variance: f64 = row.iter().zip(known).map(|(y, c)| y * c).sum();
                weight * variance / noise
            })
            .collect()
    }

    fn uneven(count: usize) -> Estimate {
        let even = fibonacci(count).into_iter().enumerate();
        let kept = even.filter(|(i, n)| n.x > 0.0 || i % 6 == 0);
        let directions: Vec<_> = kept.map(|(_, n)| n).collect();
        let bumps = |n: &Vector3<f64>| {
            3.0 + 0.2 * (4.0 * n.x + 1.0).sin() * (5.0 * n.y).cos() + 0.1 * (7.0 * n.z).sin()
        };
        let estimate = estimated(&samples(&directions, bumps, 0.05), Vector3::repeat(3.0));
        assert!(estimate.cloud.is_uneven() && estimate.factor.is_some());
        estimate
    }

    #[test]
    fn thin_parts_of_a_cloud_have_the_leverage_of_their_density() {
        let estimate = uneven(900);
        let exact = by_definition(&estimate);
        let told: Vec<f64> = guessed(&estimate).iter().map(|spare| 1.0 - spare).collect();
        let mean = |leverages: &[f64], is_thin: bool| {
            let points = leverages.iter().zip(&estimate.cloud.directions);
            let (sum, count) = points
                .filter(|(_, n)| (n.x < -0.3) == is_thin && n.x.abs() > 0.3)
                .fold((0.0, 0.0), |(sum, count), (h, _)| (sum + h, count + 1.0));
            sum / count
        };
        for is_thin in [true, false] {
            let (exact, told) = (mean(&exact, is_thin), mean(&told, is_thin));
            assert!(
                (told / exact - 1.0).abs() < 0.1,
                "{is_thin}: {told} {exact}"
            );
        }
        assert!(mean(&exact, true) > 1.5 * mean(&exact, false));
    }

    /// Of furrows along the axis, of which high orders tell, points by the equator have more than those by the poles.
    #[test]
    fn leverages_of_a_furrowed_grain_depend_on_the_polar_angle() {
        let furrows = |n: &Vector3<f64>| {
            let (azimuth, out) = (n.y.atan2(n.x), n.x.hypot(n.y));
            3.0 + 0.1 * out.powi(16) * (16.0 * azimuth).cos()
                + 0.1 * out.powi(11) * (11.0 * azimuth + 1.0).sin()
        };
        let estimate = estimated(
            &samples(&fibonacci(1500), furrows, 0.02),
            Vector3::repeat(3.0),
        );
        assert!(estimate.spectrum.tilt > 0.0 && !estimate.cloud.is_uneven());
        let exact = by_definition(&estimate);
        let told: Vec<f64> = guessed(&estimate).iter().map(|spare| 1.0 - spare).collect();
        let mean = |leverages: &[f64], is_polar: bool| {
            let points = leverages.iter().zip(&estimate.cloud.directions);
            let own = points.filter(|(_, n)| {
                if is_polar {
                    n.z.abs() > 0.8
                } else {
                    n.z.abs() < 0.3
                }
            });
            let (sum, count) = own.fold((0.0, 0.0), |(sum, count), (h, _)| (sum + h, count + 1.0));
            sum / count
        };
        for is_polar in [true, false] {
            let (exact, told) = (mean(&exact, is_polar), mean(&told, is_polar));
            assert!(
                (told / exact - 1.0).abs() < 0.01,
                "{is_polar}: {told} {exact}"
            );
        }
        assert!(mean(&exact, false) > 1.2 * mean(&exact, true));
    }

    #[test]
    fn leverages_are_those_of_their_definition() {
        let estimate = uneven(900);
        let defined = by_definition(&estimate);
        let computed = Exact::new(&estimate).spares().unwrap();
        let probed = probed(&estimate);
        for ((h, computed), probed) in defined.iter().zip(&computed).zip(&probed) {
            assert!((1.0 - h - computed).abs() < 1e-9, "{h} {computed}");
            assert!((1.0 - h - probed).abs() < 0.1, "{h} {probed}");
        }
        let squares = defined
            .iter()
            .zip(&probed)
            .map(|(h, p)| (1.0 - h - p).powi(2));
        let rms = (squares.sum::<f64>() / probed.len() as f64).sqrt();
        assert!(rms < 0.03, "{rms}");
    }

    /// Of a spindle, clean, whose points the estimate all but meets.
    #[test]
    fn points_that_are_left_out_are_missed_as_told() {
        let radius = |n: &Vector3<f64>| {
            ((n.x / 3.0).abs().powf(1.3) + n.y.hypot(n.z).powf(1.3)).powf(-1.0 / 1.3)
        };
        let estimate = estimated(
            &samples(&fibonacci(120), radius, 0.0),
            Vector3::new(3.0, 1.0, 1.0),
        );
        let residuals = estimate.posterior().residuals(&estimate.coefficients);
        let told: Vec<f64> = residuals
            .iter()
            .zip(estimate.spares())
            .map(|(e, spare)| e / spare)
            .collect();
        let missed = |i: usize| {
            let others = estimate.cloud.without(&[i]);
            let posterior = Posterior::new(&others, estimate.degree, true);
            let (mean, _) = posterior.given(&estimate.spectrum).mean(None, 0.0);
            let only: Vec<usize> = (0..estimate.cloud.len()).filter(|&j| j != i).collect();
            let point = estimate.cloud.without(&only);
            Posterior::new(&point, estimate.degree, false).residuals(&mean)[0]
        };
        let largest = residuals.iter().map(|e| e.abs()).fold(0.0, f64::max);
        for i in [0, 31, 60, 119] {
            let missed = missed(i);
            assert!(
                (told[i] / missed - 1.0).abs() < 1e-3,
                "{i}: {} {missed}",
                told[i]
            );
        }
        let squares: f64 = told.iter().map(|e| e * e).sum();
        let rms = (squares / told.len() as f64).sqrt();
        assert!(rms > 1.5 * largest, "{rms} {largest}");
        let held_out = estimate.held_out() / estimate.cloud.mean;
        assert!(
            held_out > 1.5 * estimate.held_out_by_mean() / estimate.cloud.mean,
            "{held_out}"
        );
    }
}
