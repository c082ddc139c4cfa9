//! What an estimate flattens of tips and edges.
//!
//! The prior is alike everywhere and takes the last of a tip for noise: of what the points tell of degree l it keeps the share
//! 1 - q_l. So what it kept tells what it took: q_l / (1 - q_l) times as much, and where less than half was kept, which is noise for
//! the most part, at most as much again. Where fewer points lie, more is taken.
//!
//! Degrees beyond the last of which the points tell more than that, L, are missing for the most part. At a tip and at an edge the parts of a radius fall with their degree as 1 / l²:
//! those beyond L come to 1 / L, and those between the shares a and b of L to (1 / a - 1 / b) / L. So each of the last three
//! quarters of the degrees tells what lies beyond. It is the least that they tell where they agree on its sign, and nothing where
//! they do not: parts of texture have any sign.

use super::outcome::Estimate;
use crate::sphere::coefficient_count;
use crate::vectorize::dot;

/// At most so many times what was kept is taken: where less than half was kept, it is noise for the most part.
const MOST: f64 = 1.0;

/// Degrees from which a tip or an edge can be told: of fewer, each has its own shape.
const LEAST_DEGREES: usize = 12;

/// Parts of the degrees, by quarters.
const QUARTERS: usize = 4;

/// What lies beyond the highest degree is at most so many times the largest residual that it leaves: of cones, lenses and drops of
/// dense points 2 to 10 times, of particles that end with a degree a thousand times.
const OVER_RESIDUALS: f64 = 10.0;

/// Share of what lies beyond that counts: lengths and areas of double cones, drops and lenses of dense points are 1 to 2 times that too
/// small, those of cones in noise once, and those of rough kernels less.
const OF_BEYOND: f64 = 0.5;

impl Estimate {
    /// How many times what the estimate has of a degree the prior took, where the prior's odds against what the points tell are so
    /// many times as large as on the whole.
    pub(super) fn taken(&self, l: usize, odds: f64) -> f64 {
        let kept = (1.0 - self.unlearnt[l]).max(f64::MIN_POSITIVE);
        (odds * self.unlearnt[l] / kept).min(MOST)
    }
}

/// By how much values that are linear in the coefficients are too small.
pub(super) struct Flattened<'a> {
    estimate: &'a Estimate,
    largest_residual: f64,
}

impl<'a> Flattened<'a> {
    /// Residuals in units of the mean.
    pub(super) fn new(estimate: &'a Estimate, residuals: &[f64]) -> Self {
        let sizes = residuals.iter().map(|residual| residual.abs());
        Self {
            estimate,
            largest_residual: sizes.fold(0.0, f64::max),
        }
    }

    /// Of the radius where the harmonics are these, in units of the mean, with such [odds](Estimate::taken).
    pub(super) fn of_radius(&self, harmonics: &[f64], odds: f64) -> f64 {
        let parts = self.parts(harmonics);
        self.taken(&parts, odds) + self.bounded(self.beyond(&parts, odds))
    }

    /// Of figures with these gradients, of which the first is the area, which is so large.
    pub(super) fn of_figures(&self, gradients: &[Vec<f64>], area: f64) -> Vec<f64> {
        let parts: Vec<Vec<f64>> = gradients.iter().map(|of| self.parts(of)).collect();
        let mut flattened: Vec<f64> = parts.iter().map(|of| self.taken(of, 1.0)).collect();
        flattened[0] += area * self.bounded(beyond(&parts[0]) / area);
        flattened
    }

    /// What the degrees add to the value.
    fn parts(&self, functional: &[f64]) -> Vec<f64> {
        let own = |l: usize| l * l..coefficient_count(l);
        let part = |l: usize| dot(&functional[own(l)], &self.estimate.coefficients[own(l)]);
        (0..=self.estimate.degree).map(part).collect()
    }

    /// What lies beyond the degrees of which the points tell more than the prior takes.
    fn beyond(&self, parts: &[f64], odds: f64) -> f64 {
        let taken = |l: usize| self.estimate.taken(l, odds);
        let told = (0..parts.len()).rposition(|l| taken(l) < MOST);
        let told = 0..told.map_or(0, |last| last + 1);
        let whole: Vec<f64> = told.map(|l| parts[l] * (1.0 + taken(l))).collect();
        beyond(&whole)
    }

    /// What counts of what lies beyond, as shares of the mean or of the area.
    fn bounded(&self, beyond: f64) -> f64 {
        let most = OVER_RESIDUALS * self.largest_residual;
        OF_BEYOND * beyond.clamp(-most, most)
    }

    fn taken(&self, parts: &[f64], odds: f64) -> f64 {
        let taken = parts.iter().enumerate();
        taken
            .map(|(l, part)| self.estimate.taken(l, odds) * part)
            .sum()
    }
}

/// What lies beyond the parts by degree.
fn beyond(parts: &[f64]) -> f64 {
    if parts.len() < LEAST_DEGREES {
        return 0.0;
    }
    let told = (1..QUARTERS).map(|quarter| {
        let [from, to] = [quarter, quarter + 1].map(|end| end * parts.len() / QUARTERS);
        let [a, b] = [from, to].map(|end| end as f64 / parts.len() as f64);
        parts[from..to].iter().sum::<f64>() / (1.0 / a - 1.0 / b)
    });
    let [least, most] = told.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], told| {
        [told.min(least), told.max(most)]
    });
    least.max(0.0) + most.min(0.0)
}

#[cfg(test)]
mod tests {
    use super::super::trial::{estimated, fibonacci, samples};
    use super::*;
    use approx::assert_relative_eq;
    use nalgebra::Vector3;

    #[test]
    fn beyond_the_last_degree_lies_the_rest_of_a_tip() {
        let part = |l: usize| 1.0 / (l.max(1) as f64 - 0.5).powi(2);
        let rest: f64 = (61..100_000).map(part).sum();
        let tip: Vec<f64> = (0..=60).map(part).collect();
        assert_relative_eq!(beyond(&tip), rest, max_relative = 0.03);
        let hollow: Vec<f64> = tip.iter().map(|part| -part).collect();
        assert_eq!(beyond(&hollow), -beyond(&tip));
        assert_eq!(beyond(&tip[..LEAST_DEGREES - 1]), 0.0);
        // Of a round one nearly nothing; where the quarters disagree, nothing.
        let round: Vec<f64> = (0..=60).map(|l| 0.7_f64.powi(l)).collect();
        assert!(beyond(&round) < 1e-6);
        let turned = tip.iter().enumerate();
        let turned: Vec<f64> = turned
            .map(|(l, part)| if l > 45 { -part } else { *part })
            .collect();
        assert_eq!(beyond(&turned), 0.0);
    }

    #[test]
    fn what_is_taken_of_a_degree_follows_from_what_is_kept() {
        let mut estimate = estimated(
            &samples(&fibonacci(400), |_| 2.0, 0.01),
            Vector3::repeat(2.0),
        );
        estimate.coefficients.fill(0.0);
        let own = 5 * 5 + 2;
        estimate.coefficients[own] = 0.3;
        let mut functional = vec![0.0; estimate.coefficients.len()];
        functional[own] = 2.0;
        let mut flattened = |unlearnt: f64, odds: f64| {
            estimate.unlearnt[5] = unlearnt;
            Flattened::new(&estimate, &[]).of_radius(&functional, odds)
        };
        assert_eq!(flattened(0.0, 1.0), 0.0);
        assert_relative_eq!(flattened(0.2, 1.0), 0.6 * 0.25);
        assert_relative_eq!(flattened(0.2, 3.0), 0.6 * 0.75);
        // No more than was kept.
        assert_relative_eq!(flattened(0.9, 1.0), 0.6);
        assert_relative_eq!(flattened(1.0, 1.0), 0.6);
    }

    #[test]
    fn what_lies_beyond_leaves_residuals() {
        let cloud = samples(&fibonacci(400), |_| 2.0, 0.0);
        let mut estimate = estimated(&cloud, Vector3::repeat(2.0));
        estimate.unlearnt.fill(0.0);
        let degrees = 0..=estimate.degree;
        let tip = degrees.flat_map(|l| {
            let part = 1.0 / (l.max(1) as f64).powi(2);
            std::iter::repeat_n(part / (2 * l + 1) as f64, 2 * l + 1)
        });
        estimate.coefficients = tip.collect();
        let at = vec![1.0; estimate.coefficients.len()];
        let beyond = OF_BEYOND / estimate.degree as f64;
        let told = |residuals: &[f64]| Flattened::new(&estimate, residuals).of_radius(&at, 1.0);
        assert_relative_eq!(told(&[0.001, -0.1]), beyond, max_relative = 0.1);
        assert_relative_eq!(told(&[0.0003, -0.0005]), 0.0025);
        // Of figures the area alone.
        let figures =
            Flattened::new(&estimate, &[0.001]).of_figures(&[at.clone(), at.clone()], 2.0);
        assert_relative_eq!(figures[0], 0.01);
        assert_eq!(figures[1], 0.0);
    }
}
