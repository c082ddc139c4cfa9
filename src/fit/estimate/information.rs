//! Second derivatives of the exact likelihood by the spectrum, at the price of five solutions.
//!
//! They hold traces that cost as much as the factor again, and so do their expected values. The mean of both does not
//! (average information: Gilmour, Thompson, Cullis 1995). With K = Y V Y' + s^2 W^-1, its inverse P, and K_i the
//! derivatives of K by the logarithms,
//!
//! ```text
//! A_ij = 1/2 (K_i P y)' P (K_j P y)
//! ```
//!
//! of which nothing is left but the mean x of the coefficients and its covariance C. With D_i = diag(d log v_l), the
//! residuals e, and b_i = V^-1 D_i x or, of the noise, b = V^-1 x,
//!
//! ```text
//! A_ij = 1/2 (x'D_i b_j - b_i'C b_j)    of the noise and i: b_i'C b    of the noise: 2 (e'We / s^2 - b'C b)
//! ```

use super::posterior::Conditioned;
use super::spectrum::{NOISE, PARAMETERS, Spectrum};
use crate::vectorize::dot;
use nalgebra::Matrix5;

impl Conditioned<'_> {
    /// The average information of the spectrum's logarithms, where the matrix is factored.
    pub(super) fn information(&self, spectrum: &Spectrum, mean: &[f64]) -> Option<Matrix5<f64>> {
        let factor = self.factor.as_ref()?;
        // The derivatives of the mean by the logarithms, were nothing learnt; and these over the variances.
        let mut moved = vec![vec![0.0; mean.len()]; PARAMETERS];
        for (l, term) in spectrum.terms(self.degrees.len() - 1).enumerate() {
            for j in l * l..(l + 1) * (l + 1) {
                for (i, slope) in term.slopes.into_iter().enumerate() {
                    moved[i][j] = slope * mean[j];
                }
                moved[NOISE][j] = mean[j];
            }
        }
        let over = |moved: &Vec<f64>| -> Vec<f64> {
            moved
                .iter()
                .zip(&self.variances)
                .map(|(x, v)| x / v)
                .collect()
        };
        let rights: Vec<Vec<f64>> = moved.iter().map(over).collect();
        let solved = self.solve_factored(factor, &rights);
        let residuals = self.posterior.residuals(mean);
        let squared = self.posterior.cloud.squares(residuals);
        Some(Matrix5::from_fn(|i, j| {
            let left = dot(&rights[i], &solved[j]);
            match (i == NOISE, j == NOISE) {
                (false, false) => 0.5 * (dot(&moved[i], &rights[j]) - left),
                (true, true) => 2.0 * (squared / self.noise - left),
                _ => left,
            }
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::super::cloud::Cloud;
    use super::super::posterior::Posterior;
    use super::super::spectrum::TEXTURE;
    use super::*;
    use crate::shapes::Sampling;
    use nalgebra::Vector3;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    /// Of points that a spectrum has made, second derivatives are near their expected values, and so near the mean of
    /// both.
    #[test]
    fn it_is_near_the_second_derivatives_of_the_cost() {
        let smooth = Spectrum::with_amplitude([-3.0, 0.8, 1.1, 0.01_f64.ln()]);
        compare(smooth, &[(0, 0), (1, 1), (3, 3), (0, 1), (0, 3)]);
        // The shape ends where the texture begins.
        let mut textured = Spectrum::with_amplitude([-3.0, 2.0, 1.1, 0.01_f64.ln()]);
        textured.logarithms[TEXTURE] = -9.0;
        compare(textured, &[(3, 3), (4, 4), (3, 4)]);
    }

    fn compare(truth: Spectrum, pairs: &[(usize, usize)]) {
        let (degree, points) = (14, 1200);
        let mut random = ChaCha8Rng::seed_from_u64(4);
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        let mut coefficients = vec![(4.0 * std::f64::consts::PI).sqrt()];
        for (l, variance) in truth.variances(degree).into_iter().enumerate().skip(1) {
            let size = if l < 3 { 0.02 } else { variance.sqrt() };
            coefficients.extend((0..=2 * l).map(|_| size * normal()));
        }
        let directions = Sampling::Fibonacci.directions(points, 0).unwrap();
        let basis = crate::sphere::HarmonicBasis::new(degree);
        let samples: Vec<_> = directions
            .iter()
            .map(|n| {
                [
                    n.x,
                    n.y,
                    n.z,
                    basis.value(&coefficients, n) + 0.01 * normal(),
                ]
            })
            .collect();
        let cloud = Cloud::new(&samples, None, Vector3::repeat(1.0), Vector3::repeat(1.0));
        let posterior = Posterior::new(&cloud, degree, true);
        let cost = |spectrum: &Spectrum| {
            let given = posterior.given(spectrum);
            let (mean, _) = given.mean(None, 0.0);
            given.cost(&mean).unwrap()
        };
        let given = posterior.given(&truth);
        let (mean, _) = given.mean(None, 0.0);
        let found = given.information(&truth, &mean).unwrap();
        let at = |moves: [(usize, f64); 2]| {
            let mut moved = truth;
            for (i, by) in moves {
                moved.logarithms[i] += by;
            }
            cost(&moved)
        };
        let h = 0.02;
        for &(i, j) in pairs {
            let mixed = at([(i, h), (j, h)]) + at([(i, -h), (j, -h)])
                - at([(i, h), (j, -h)])
                - at([(i, -h), (j, h)]);
            let want = mixed / (4.0 * h * h);
            let scale = (found[(i, i)] * found[(j, j)]).sqrt();
            let error = (found[(i, j)] - want).abs() / scale;
            assert!(error < 0.25, "{i} {j}: {} {want}", found[(i, j)]);
        }
    }
}
