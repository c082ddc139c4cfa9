//! The search for the degree of an estimate: higher ones are tried as long as the last degrees of one carry something, and
//! points that stand alone are left out of each.

use super::cloud::Cloud;
use super::map::Stretched;
use super::outcome::{LAST_DEGREES, last_power};
use super::outliers::{ROUNDS, alone};
use super::patches::Patches;
use super::posterior::{Posterior, is_small};
use super::spectrum_fit::SpectrumFit;
use super::spectrum_search::{Count, fit_spectrum};
use super::stopping::MOST_FACTORED_DEGREE;
use super::tilt::most_likely;
use super::unresolved::FLOOR;
use crate::fit::context::{Cancelled, Context};
use crate::sphere::coefficient_count;
use std::sync::Arc;

/// Degrees that are tried, as long as the last degrees of one carry something.
const DEGREES: [usize; 5] = [36, 48, 60, 72, 80];

/// A higher degree is kept if points that are left out are missed by this share less: else what the last degrees carried was
/// noise, of which the prior expected more. The likelihood does not tell: as far as it is known of so many points it is off by
/// a thousand in its logarithm, one way or the other.
const WORTH_A_DEGREE: f64 = 0.01;

/// Coefficients per point beyond which a higher degree is not tried: what is left of detail is noise to a lower one. With 1.4, where
/// it was .9, eight of eight textured scans of 3000 to 4500 points are nearer to points that were held out, by 1 to 9 %, with as many
/// coefficients of their cells; with 2.2 by another percent, in twice the time.
const MOST_PER_POINT: f64 = 1.4;

/// The same of points without noise to speak of, which lower degrees meet: with 1.4 a clean particle of NIST took 4 to 18 s instead of 1,
/// to the same surface.
const MOST_PER_CLEAN_POINT: f64 = 0.9;

/// The degree that a cloud of so many points is first fitted at.
pub(super) fn first_degree(points: usize) -> usize {
    match points {
        0..=20 => 16,
        21..=100 => 30,
        _ => DEGREES[0],
    }
}

/// A cloud that is fitted with one degree after the other.
pub(super) struct Degrees {
    pub(super) cloud: Cloud,
    /// Those of which the cloud is the means.
    pub(super) patches: Option<Patches>,
    pub(super) degree: usize,
    pub(super) fit: SpectrumFit,
    /// Points left out.
    pub(super) outliers: usize,
    /// Rounds of leaving out.
    rounds: usize,
    may_stand_alone: bool,
    /// Whether the matrix is factored.
    is_factored: bool,
    /// Whether `fit` is one of this degree to this cloud.
    is_fitted: bool,
    /// The degree below and its fit, which this one has to beat.
    lower: Option<(usize, SpectrumFit)>,
    /// A fit of a higher degree to more points, from which that to fewer starts.
    higher: Option<(usize, SpectrumFit)>,
}

impl Degrees {
    pub(super) fn new(
        stretched: Stretched,
        patches: Option<Patches>,
        first: usize,
        may_stand_alone: bool,
    ) -> Self {
        let Stretched {
            cloud,
            mut fit,
            outliers,
        } = stretched;
        let compared = fit.sums.degree();
        let mut degree = first;
        if is_small(cloud.len()) {
            if fit.is_enough() && !fit.leaves_waves(&cloud, first) {
                degree = compared;
            }
            fit.spectrum = fit.spectrum.raised(compared, degree);
        }
        // The comparison of maps may have found the exact likelihood at this degree.
        let is_fitted = fit.factor.is_some() && compared == first;
        if !is_fitted {
            let tilt = most_likely(&fit.coefficients, &fit.unlearnt, &fit.spectrum);
            fit.spectrum = fit.spectrum.tilted(tilt);
        }
        Self {
            is_factored: is_small(cloud.len()),
            outliers: patches
                .as_ref()
                .map_or(outliers, |patches| patches.left_out),
            cloud,
            patches,
            degree,
            fit,
            rounds: 0,
            may_stand_alone,
            is_fitted,
            lower: None,
            higher: None,
        }
    }

    /// The same at the degree that suits the points.
    pub(super) fn searched(mut self, context: &Context<'_>) -> Result<Self, Cancelled> {
        loop {
            context.check()?;
            if !self.is_fitted {
                self.fit();
            }
            if !self.leaves_out() && !self.goes_on() {
                return Ok(self);
            }
        }
    }

    fn fit(&mut self) {
        let posterior = Posterior::new(&self.cloud, self.degree, self.is_factored);
        let mut coefficients = std::mem::take(&mut self.fit.coefficients);
        coefficients.resize(coefficient_count(self.degree), 0.0);
        let spectrum = self.fit.spectrum;
        self.fit = fit_spectrum(&posterior, spectrum, Some(coefficients), Count::Probed);
        if self.fit.is_hard {
            self.is_factored = true;
            self.fit();
        }
    }

    /// Leaves out points that stand alone, and goes back to the lower degree, which was fitted to all points. Whether there
    /// were any.
    fn leaves_out(&mut self) -> bool {
        let are_told = self.patches.as_ref().is_none_or(Patches::are_some_thin);
        if !self.may_stand_alone || self.rounds == ROUNDS || !are_told {
            return false;
        }
        let posterior = Posterior::with(&self.cloud, Arc::clone(&self.fit.sums));
        let alone = alone(&posterior, &self.fit);
        let left_out = match &mut self.patches {
            Some(patches) => {
                patches.leave_out(&alone, |places| self.fit.residuals(places, &self.cloud))
            }
            None => alone.len(),
        };
        if left_out == 0 {
            return false;
        }
        self.rounds += 1;
        self.outliers += left_out;
        self.cloud = match &self.patches {
            Some(patches) => Cloud::new(
                &patches.means,
                Some(&patches.counts),
                self.cloud.stretch,
                self.cloud.semi_axes,
            ),
            None => self.cloud.without(&alone),
        };
        if let Some((degree, fit)) = self.lower.take() {
            let higher = std::mem::replace(&mut self.fit, fit);
            self.higher = Some((std::mem::replace(&mut self.degree, degree), higher));
        }
        self.is_fitted = false;
        true
    }

    /// Goes on to a higher degree, or back to the lower one for good. Whether there is a higher one.
    fn goes_on(&mut self) -> bool {
        if let Some((degree, before)) = self.lower.take() {
            let limit = (1.0 - WORTH_A_DEGREE) * before.held_out(&self.cloud);
            if self.fit.held_out(&self.cloud) > limit {
                (self.degree, self.fit) = (degree, before);
                return false;
            }
        }
        let Some(next) = self.next() else {
            return false;
        };
        let start = match self.higher.take().filter(|(higher, _)| *higher == next) {
            Some((_, before)) => before,
            None => SpectrumFit {
                spectrum: self.fit.spectrum.raised(self.degree, next),
                ..self.fit.clone()
            },
        };
        self.lower = Some((self.degree, std::mem::replace(&mut self.fit, start)));
        self.degree = next;
        self.is_fitted = false;
        true
    }

    /// A higher degree, if the last ones carry something and the points are enough: the next one, or the highest at once where
    /// even that is expected to carry something to its end.
    fn next(&self) -> Option<usize> {
        let points = self.cloud.len();
        let carried = last_power(&self.fit.coefficients, self.degree);
        if is_small(points) || self.fit.hides(carried) {
            return None;
        }
        let per_point = match self.fit.spectrum.noise() < FLOOR {
            true => MOST_PER_CLEAN_POINT,
            false => MOST_PER_POINT,
        };
        let most = per_point * points as f64;
        let is_cheap = |degree| !self.is_factored || degree <= MOST_FACTORED_DEGREE;
        let mut higher = DEGREES.into_iter().filter(|&next| {
            next > self.degree && coefficient_count(next) as f64 <= most && is_cheap(next)
        });
        let highest = higher.clone().next_back()?;
        match self
            .fit
            .expects_little(highest - LAST_DEGREES, highest, points)
        {
            true => higher.next(),
            false => Some(highest),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::trial::{estimated, fibonacci, samples};
    use super::*;
    use crate::sphere::HarmonicBasis;
    use crate::vectorize::dot;
    use nalgebra::Vector3;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    /// At degree 36, after 30, of which points are missed by so many times as much.
    fn above(times: f64) -> Degrees {
        let cloud = samples(&fibonacci(3200), |n| 3.0 + 0.5 * n.z.powi(3), 0.01);
        let estimate = estimated(&cloud, Vector3::repeat(3.0));
        let fit = SpectrumFit {
            spectrum: estimate.spectrum,
            coefficients: estimate.coefficients,
            unlearnt: estimate.unlearnt,
            cost: 0.0,
            sums: estimate.sums,
            factor: None,
            is_hard: false,
        };
        let cloud = estimate.cloud;
        let mut lower = fit.clone();
        // A surface that is off everywhere by d misses points by hypot(d, noise).
        let missed = Posterior::with(&cloud, Arc::clone(&fit.sums)).mean_square(&fit.coefficients);
        let off = (missed * (times * times - 1.0)).sqrt();
        lower.coefficients[0] += off * (4.0 * std::f64::consts::PI).sqrt();
        Degrees {
            cloud,
            patches: None,
            degree: 36,
            fit,
            outliers: 0,
            rounds: 0,
            may_stand_alone: true,
            is_factored: false,
            is_fitted: true,
            lower: Some((30, lower)),
            higher: None,
        }
    }

    #[test]
    fn a_higher_degree_is_kept_where_points_left_out_are_missed_by_a_hundredth_less() {
        for (times, kept) in [(1.0, 30), (1.005, 30), (1.05, 36)] {
            let mut degrees = above(times);
            assert!(!degrees.goes_on());
            assert_eq!(degrees.degree, kept, "{times}");
        }
    }

    /// One side is seen twenty times more densely than the other.
    #[test]
    fn an_uneven_cloud_is_factored_and_right_where_it_is_thin() {
        let basis = HarmonicBasis::new(18);
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let coefficients = (0..coefficient_count(18)).map(|at| {
            let normal: f64 = StandardNormal.sample(&mut random);
            0.1 * normal / (1.0 + at as f64 / 16.0)
        });
        let coefficients: Vec<f64> = coefficients.collect();
        let radius = |n: &Vector3<f64>| {
            let mut values = vec![0.0; coefficients.len()];
            basis.evaluate(n, &mut values);
            3.0 + dot(&values, &coefficients)
        };
        let even = fibonacci(8000);
        let is_seen = |(i, n): &(usize, &Vector3<f64>)| n.z > 0.0 || i % 20 == 0;
        let seen = even.iter().enumerate().filter(is_seen).map(|(_, n)| *n);
        let seen: Vec<Vector3<f64>> = seen.collect();
        let axes = Vector3::repeat(3.0);
        let found = estimated(&samples(&seen, radius, 0.0), axes);
        assert!(found.factor.is_some());
        let below: Vec<Vector3<f64>> = even.iter().copied().filter(|n| n.z < -0.2).collect();
        let fitted = found.stretched_radii(&below);
        let posterior = found.posterior();
        let variances = found.given(&posterior).directional_variances(&below);
        let mean = found.cloud.mean;
        let squares = below.iter().zip(&fitted).zip(&variances);
        let squares = squares.map(|((n, r), v)| ((r - radius(n)) / mean).powi(2) / v);
        let z = (squares.sum::<f64>() / below.len() as f64).sqrt();
        assert!(z < 2.0, "{z}");
        let alike = estimated(&samples(&fibonacci(4200), radius, 0.01), axes);
        assert!(alike.factor.is_none());
    }
}
